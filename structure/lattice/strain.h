// SPDX-License-Identifier: GPL-2.0-or-later
// Measures of an element's deformation: stretches, stress.
#pragma once

#include <Eigen/Core>
#include <array>

#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// Mean deformation gradient F = sum_a x_a b_a^T / V0 (element.h).
Eigen::Matrix3d mean_deformation(const Positions8& x_m,
                                 const Positions8& reference_gradient_m2,
                                 double reference_volume_m3);

// Principal stretches, the square roots of the eigenvalues of F^T F, largest first.
Vec3 principal_stretches(const Eigen::Matrix3d& f);

// Cauchy stress of eq. (1) in a homogeneous state, sigma = P F^T / J with P = dW/dF:
//   sigma = (G (F F^T - 1) + K ln J 1) / J  [Pa],
// with F F^T times 2 W' / G for a material that stiffens,
// zero if J is not positive. The order is VTK's for six components: xx, yy, zz, xy, yz,
// xz.
std::array<double, 6> cauchy_stress_pa(const Material& material,
                                       const Eigen::Matrix3d& f);

}  // namespace magfsi::structure
