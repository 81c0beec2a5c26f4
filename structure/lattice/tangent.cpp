// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/tangent.h"

#include <cmath>
#include <span>

namespace magfsi::structure {
namespace {

// The volume is a sum of triple products c u_l . (u_m x u_n) of vectors that are linear
// in the positions, u_m = sum_a p_am x_a.
struct TripleProduct {
    int l, m, n;
    double coefficient;
};

// Exact volume, u_m the Hadamard modes: V = 8 [r1.(r2 x r3) + (r1.(s12 x s31) +
// r2.(s23 x s12) + r3.(s31 x s23)) / 3], the formula of exact_volume().
constexpr std::array<TripleProduct, 4> exact_terms{
    {{1, 2, 4, 8.0}, {1, 3, 5, 8.0 / 3}, {2, 6, 3, 8.0 / 3}, {4, 5, 6, 8.0 / 3}}};
// V0 det F, u_m the columns of F.
constexpr std::array<TripleProduct, 1> mean_terms{{{0, 1, 2, 1.0}}};

using Weights = Eigen::Matrix<double, 8, 8>;  // p_am

// d2V / dx_a dx_b = sum over terms of the cross-product matrix of w_ab, a combination of
// the u: d2/(du_l du_m) of u_l . (u_m x u_n) is -[u_n]x, and cyclic.
Matrix24 hessian(std::span<const TripleProduct> terms, const Weights& p,
                 const Eigen::Matrix<double, 8, 3>& u) {
    std::array<Weights, 3> w;
    for (Weights& component : w) component.setZero();
    const auto couple = [&](int m, int n, int third, double coefficient) {
        for (int d = 0; d < 3; ++d) {
            w[d](m, n) -= coefficient * u(third, d);
            w[d](n, m) += coefficient * u(third, d);
        }
    };
    for (const auto& [l, m, n, c] : terms) {
        couple(l, m, n, c);
        couple(m, n, l, c);
        couple(n, l, m, c);
    }
    for (Weights& component : w) component = p * component * p.transpose();
    Matrix24 out;
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) {
            const Eigen::Vector3d v(w[0](a, b), w[1](a, b), w[2](a, b));
            out.block<3, 3>(3 * a, 3 * b) << 0, -v(2), v(1), v(2), 0, -v(0), -v(1), v(0),
                0;
        }
    }
    return out;
}

Weights exact_weights() {
    Weights p;
    for (int a = 0; a < 8; ++a) {
        for (int m = 0; m < 8; ++m) p(a, m) = 0.125 * mode_sign(m, a);
    }
    return p;
}

// Columns 0 to 2: b_a / V0.
Weights mean_weights(const ElementReference& reference) {
    Weights p = Weights::Zero();
    p.leftCols<3>() = reference.gradient / reference.volume;
    return p;
}

}  // namespace

VolumeDerivatives volume_derivatives(const ElementReference& reference,
                                     const Positions8& x_m) {
    const VolumeAndGradient v = element_volume(reference, x_m);
    VolumeDerivatives out{v.volume_m3, v.gradient_m2, {}};
    if (reference.variant == ElementVariant::full) {
        static const Weights p = exact_weights();
        out.hessian_m = hessian(exact_terms, p, p.transpose() * x_m);
    } else {
        const Weights p = mean_weights(reference);
        out.hessian_m = reference.volume * hessian(mean_terms, p, p.transpose() * x_m);
    }
    return out;
}

VolumetricStress volumetric_stress(const Material& material, double volume_ratio) {
    const double g = material.shear_modulus_pa;
    const double k = material.lame_lambda_pa;
    const double log_j = std::log(volume_ratio);
    return {(k * log_j - g) / volume_ratio,
            (k * (1 - log_j) + g) / (volume_ratio * volume_ratio)};
}

Matrix24 element_tangent(const ElementReference& reference, const Material& material,
                         const VolumeDerivatives& volume,
                         const VolumetricStress& stress) {
    const Eigen::Vector<double, 24> slope =
        volume.gradient_m2.reshaped<Eigen::RowMajor>();
    const Eigen::Vector<double, 24> scaled = stress.modulus_pa / reference.volume * slope;
    Matrix24 out = stress.pressure_pa * volume.hessian_m;
    out.noalias() += scaled * slope.transpose();
    const Matrix8 springs = material.shear_modulus_pa * reference.spring_matrix;
    for (int b = 0; b < 8; ++b) {
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) out(3 * a + d, 3 * b + d) += springs(a, b);
        }
    }
    return out;
}

Matrix24 element_tangent(const ElementReference& reference, const Material& material,
                         const Positions8& x_m) {
    const Positions8 x = x_m.rowwise() - x_m.colwise().mean();
    const VolumeDerivatives volume = volume_derivatives(reference, x);
    Matrix24 out =
        element_tangent(reference, material, volume,
                        volumetric_stress(material, volume.volume_m3 / reference.volume));
    if (reference.variant == ElementVariant::assumed_strain) {
        out += hourglass_tangent(reference.hourglass, material, x);
    }
    return out;
}

}  // namespace magfsi::structure
