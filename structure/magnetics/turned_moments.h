// SPDX-License-Identifier: GPL-2.0-or-later
// Remanence that follows the rotation of the material, not its stretch: the moment of an
// element is V0 R M, with R the rotation of the polar decomposition F = R U of its mean
// deformation gradient. (By default it is the integral of F M, magnetic_forces.h.)
//
// Energy in a uniform flux density B: E = -V0 (R M) . B. With b = R^T B, t = M x b and
// (tr U - U) c = t the forces are f_a = R (c x b_a), b_a the integral of grad N_a.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// Rotation R of F = R U. det F must be positive.
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& f);

// Constants of an element.
struct TurnedElement {
    Positions8 gradient_m2;  // b_a
    double volume_m3 = 0;
    Eigen::Vector3d magnetization_a_m = Eigen::Vector3d::Zero();
};

// magnetization_a_m: one vector per element [A/m]; throws std::invalid_argument on
// another number.
std::vector<TurnedElement> turned_elements(const std::vector<Vec3>& nodes_m,
                                           const std::vector<Hexahedron>& elements,
                                           const std::vector<Vec3>& magnetization_a_m);

// Moment V0 R M [A m2] at these positions.
Eigen::Vector3d turned_moment(const TurnedElement& element, const Positions8& x_m);

// Adds the forces of the field [T] to f, three values per node as in x [m]; nodes: for
// each element the indices of its nodes. Returns the sum of the moments [A m2], whose
// product with -B is the energy.
Eigen::Vector3d add_turned_forces(std::span<const TurnedElement> elements,
                                  std::span<const std::array<int, 8>> nodes,
                                  const Eigen::Vector3d& field_t, const double* x,
                                  double* f);

// Second derivative of the energy of one element [N/m]; row 3 a + d is coordinate d of
// node a.
Eigen::Matrix<double, 24, 24> turned_tangent(const TurnedElement& element,
                                             const Eigen::Vector3d& field_t,
                                             const Positions8& x_m);

}  // namespace magfsi::structure
