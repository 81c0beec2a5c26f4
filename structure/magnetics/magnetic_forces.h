// SPDX-License-Identifier: GPL-2.0-or-later
// Magnetic forces on the nodes of a lattice with magnetisation fixed to the material: in
// a uniform field, in a linear field and in the field of sources.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "structure/lattice/hexahedron.h"
#include "structure/magnetics/source_field.h"

namespace magfsi::structure {

// Magnetic charge of each node [A m], eqs. (5) and (6),
//   q_a = sum over the elements e of M_e . integral over e of grad N_a,
// with N_a the node's shape function. A body with the magnetisation M, fixed to the
// material, has the energy - integral of (F M) . B in a uniform flux density B, with F
// the deformation gradient. It is linear in the positions of the nodes: each has the
// force q_a B, whatever the deformation. The charges of a body sum to zero: a uniform
// field turns and bends it but does not carry it away. magnetization_a_m: one vector per
// element [A/m], or none at all, which gives zeros; throws std::invalid_argument on
// another number.
std::vector<double> nodal_charges(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements,
                                  const std::vector<Vec3>& magnetization_a_m);

// Flux density that varies linearly in space, B(x) = B0 + A (x - origin), with the
// gradient A(d, e) = dB_d / dx_e [T/m]. By Maxwell's equations a static field without
// currents has no divergence and no curl, so that A is symmetric and its trace is zero.
// B0 is not part of this class.
class FieldGradient {
  public:
    // Throws std::invalid_argument, with the entries, if A is not finite, or not
    // symmetric or not traceless to 1e-6 of its largest entry.
    FieldGradient(const Eigen::Matrix3d& tesla_per_m, const Vec3& origin_m);

    explicit FieldGradient(const GradientInput& input);

    const Eigen::Matrix3d& tesla_per_m() const { return tesla_per_m_; }
    const Vec3& origin_m() const { return origin_m_; }

  private:
    Eigen::Matrix3d tesla_per_m_;
    Vec3 origin_m_;
};

// Constants of an element for the forces in a gradient: the integral over the undeformed
// element
//   S_ab = integral of (M . grad N_a) N_b + (M . grad N_b) N_a [A m2],
// which is symmetric. Its row a sums to the element's part of the nodal charge q_a.
struct GradientElement {
    Matrix8 coupling = Matrix8::Zero();
};

// The constants of each element of the mesh. magnetization_a_m: one vector per element
// [A/m]; throws std::invalid_argument on another number.
std::vector<GradientElement> gradient_elements(
    const std::vector<Vec3>& nodes_m, const std::vector<Hexahedron>& elements,
    const std::vector<Vec3>& magnetization_a_m);

// Adds the forces of the gradient alone to f: on node a
//   A sum_b S_ab (x_b - origin) [N].
// Returns their energy -1/2 sum_ab S_ab (x_a - origin) . A (x_b - origin) [J], which is -
// integral of (F M) . A (x - origin). Unlike the force q_a B0 of the uniform part
// (nodal_charges), they depend on the body's shape and place. nodes: for each element the
// eight indices of its nodes in x and f, which have three values per node.
double add_gradient_forces(std::span<const GradientElement> elements,
                           std::span<const std::array<int, 8>> nodes,
                           const FieldGradient& gradient, const double* x, double* f);

// Constants of each element for the field of sources: the integral over the undeformed
// element
//   C_ab = integral of (M . grad N_a) N_b [A m2].
// It shares the element's moment, integral of F M = sum_ab C_ab x_a, among its nodes: P_b
// = sum_a C_ab x_a. magnetization_a_m: as for gradient_elements.
std::vector<Matrix8> moment_elements(const std::vector<Vec3>& nodes_m,
                                     const std::vector<Hexahedron>& elements,
                                     const std::vector<Vec3>& magnetization_a_m);

// Adds the forces of a field that is known at the nodes and taken as linear between those
// of an element. samples: field at the nodes, with the same indices as x. The energy is -
// sum over b of P_b . B(x_b), which is exact for fields that are linear in space;
// otherwise its error goes with the square of the edge over the distance of the source.
// The forces are its exact derivatives,
//   on node a sum_b C_ab B(x_b) + (grad B(x_a))^T P_a.
// Returns the energy [J].
double add_source_forces(std::span<const Matrix8> moments,
                         std::span<const std::array<int, 8>> nodes,
                         std::span<const FieldSample> samples, const double* x,
                         double* f);

// Second derivative of that energy for one element [N/m]; row 3 a + d is coordinate d of
// node a.
Eigen::Matrix<double, 24, 24> source_tangent(const Matrix8& moments,
                                             const std::array<int, 8>& nodes,
                                             std::span<const FieldSample> samples,
                                             const SourceField& field, const double* x);

}  // namespace magfsi::structure
