// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/tangent.h"

#include <cmath>
#include <span>

#include "structure/lattice/stiffening.h"

namespace magfsi::structure {
namespace {

// Term c u_l . (u_m x u_n) of a volume, which is a sum of such triple products of vectors
// that are linear in the positions, u_m = sum_a p_am x_a.
struct TripleProduct {
    int l, m, n;
    double coefficient;
};

// Exact volume with u_m the Hadamard modes: V = 8 [r1.(r2 x r3) + (r1.(s12 x s31) +
// r2.(s23 x s12) + r3.(s31 x s23)) / 3], as in exact_volume().
constexpr std::array<TripleProduct, 4> exact_terms{
    {{1, 2, 4, 8.0}, {1, 3, 5, 8.0 / 3}, {2, 6, 3, 8.0 / 3}, {4, 5, 6, 8.0 / 3}}};
// Volume by the mean F over V0, det F, with u_m the columns of F.
constexpr std::array<TripleProduct, 1> mean_terms{{{0, 1, 2, 1.0}}};

template <int modes>
using Weights = Eigen::Matrix<double, 8, modes>;  // weights p_am

// Second derivative d2V / dx_a dx_b: a sum over the terms of the cross-product matrix of
// w_ab, a combination of the u. d2/(du_l du_m) of u_l . (u_m x u_n) is -[u_n]x, and
// cyclically.
template <int modes>
Matrix24 hessian(std::span<const TripleProduct> terms, const Weights<modes>& p,
                 const Eigen::Matrix<double, modes, 3>& u) {
    std::array<Eigen::Matrix<double, modes, modes>, 3> of_modes;
    for (auto& component : of_modes) component.setZero();
    const auto couple = [&](int m, int n, int third, double coefficient) {
        for (int d = 0; d < 3; ++d) {
            of_modes[d](m, n) -= coefficient * u(third, d);
            of_modes[d](n, m) += coefficient * u(third, d);
        }
    };
    for (const auto& [l, m, n, c] : terms) {
        couple(l, m, n, c);
        couple(m, n, l, c);
        couple(n, l, m, c);
    }
    std::array<Matrix8, 3> w;
    for (int d = 0; d < 3; ++d) w[d] = p * of_modes[d] * p.transpose();
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

Weights<8> exact_weights() {
    Weights<8> p;
    for (int a = 0; a < 8; ++a) {
        for (int m = 0; m < 8; ++m) p(a, m) = 0.125 * mode_sign(m, a);
    }
    return p;
}

Weights<3> mean_weights(const ElementReference& reference) {
    return reference.gradient / reference.volume;  // b_a / V0
}

}  // namespace

VolumeDerivatives volume_derivatives(const ElementReference& reference,
                                     const Positions8& x_m) {
    const VolumeAndGradient v = element_volume(reference, x_m);
    VolumeDerivatives out{v.volume_m3, v.gradient_m2, {}};
    if (reference.variant == ElementVariant::full) {
        static const Weights<8> p = exact_weights();
        out.hessian_m = hessian<8>(exact_terms, p, p.transpose() * x_m);
    } else {
        const Weights<3> p = mean_weights(reference);
        out.hessian_m = reference.volume * hessian<3>(mean_terms, p, p.transpose() * x_m);
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
    Matrix24 hourglass = Matrix24::Zero();
    if (reference.variant == ElementVariant::assumed_strain) {
        hourglass = hourglass_tangent(reference.hourglass, material, x);
        out += hourglass;
    }
    if (stiffens(material)) {
        out += stiffening_tangent(reference, material, distortion(reference, material, x),
                                  hourglass);
    }
    return out;
}

}  // namespace magfsi::structure
