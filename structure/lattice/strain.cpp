// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/strain.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "structure/lattice/stiffening.h"

namespace magfsi::structure {

Eigen::Matrix3d mean_deformation(const Positions8& x_m,
                                 const Positions8& reference_gradient_m2,
                                 double reference_volume_m3) {
    // The gradients of an element sum to zero, so that the mean affects rounding only.
    const Positions8 x = x_m.rowwise() - x_m.colwise().mean();
    return x.transpose() * reference_gradient_m2 / reference_volume_m3;
}

Vec3 principal_stretches(const Eigen::Matrix3d& f) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(f.transpose() * f,
                                                                Eigen::EigenvaluesOnly);
    const auto root = [&](int i) {
        return std::sqrt(std::max(0.0, solver.eigenvalues()[i]));  // ascending
    };
    return {root(2), root(1), root(0)};
}

std::array<double, 6> cauchy_stress_pa(const Material& material,
                                       const Eigen::Matrix3d& f) {
    const double j = f.determinant();
    if (!(j > 0)) return {};
    const double g = material.shear_modulus_pa, k = material.lame_lambda_pa;
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d left = f * f.transpose();
    if (stiffens(material))
        left *= stiffening_at(stiffening_law(material), left.trace() - 3).factor;
    const Eigen::Matrix3d s = (g * (left - one) + k * std::log(j) * one) / j;
    return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
}

}  // namespace magfsi::structure
