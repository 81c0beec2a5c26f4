// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/stiffening.h"

#include <algorithm>
#include <cmath>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// The inverse Langevin function over its argument is even in y and has a pole at y = 1:
//   L^-1(y) / y = 2 / (1 - t) + p(t),   t = y^2.
// The rest p is smooth, from 1 at t = 0 to 1/2 at t = 1. These are its coefficients by
// powers of t, fitted at Chebyshev's points of [0, 1]; the largest error of L^-1 is 4e-5
// (tests/unit/structure/stiffening.cpp).
constexpr std::array<double, 8> langevin_rest{0.9998859726, -0.1876610378, -0.5131003874,
                                              1.004516882,  -3.104855814,  2.092164148,
                                              1.871399922,  -1.670139374};
static_assert(langevin_rest.size() <= stiffening_coefficients);

StiffeningLaw law_of(const Gent& gent, double) {
    if (!(gent.limit > 0))
        refuse("a Gent material with a limit of {:g} found, it must be positive",
               gent.limit);
    StiffeningLaw law;
    law.pole = law.limit = gent.limit;
    law.coefficient[0] = 0;
    return law;
}

// f = 1 + b s + c s^2 must be positive for every s >= 0.
StiffeningLaw law_of(const Yeoh& yeoh, double shear_modulus_pa) {
    StiffeningLaw law;
    const double b = law.coefficient[1] = 4 * yeoh.c2_pa / shear_modulus_pa;
    const double c = law.coefficient[2] = 6 * yeoh.c3_pa / shear_modulus_pa;
    if (!(c >= 0) || !(b > -2 * std::sqrt(c) || b >= 0))
        refuse(
            "a Yeoh material with C2 = {:g} Pa and C3 = {:g} Pa found, which has no "
            "stiffness left when it is stretched: C3 must not be negative and C2 above "
            "{:g} Pa",
            yeoh.c2_pa, yeoh.c3_pa,
            -std::sqrt(std::max(0.0, 1.5 * yeoh.c3_pa * shear_modulus_pa)));
    return law;
}

// With t = (s + 3) / (3 N): 2 / (1 - t) = 6 N / (3 N - 3 - s), and p's powers of t become
// powers of s.
StiffeningLaw law_of(const ArrudaBoyce& chains, double) {
    const double segments = chains.locking_stretch * chains.locking_stretch;
    if (!(segments > 1))
        refuse(
            "an Arruda-Boyce material with a locking stretch of {:g} found, it must be "
            "above 1",
            chains.locking_stretch);
    StiffeningLaw law;
    law.limit = 3 * (segments - 1);
    law.pole = 6 * segments;
    std::ranges::fill(law.coefficient, 0.0);
    for (int k = langevin_rest.size() - 1; k >= 0; --k) {  // Horner's scheme in s
        for (int n = stiffening_coefficients - 1; n >= 0; --n) {
            law.coefficient[n] =
                (3 * law.coefficient[n] + (n > 0 ? law.coefficient[n - 1] : 0)) /
                (3 * segments);
        }
        law.coefficient[0] += langevin_rest[k];
    }
    const double at_rest = law.pole / law.limit + law.coefficient[0];
    law.pole /= at_rest;
    for (double& c : law.coefficient) c /= at_rest;
    return law;
}

}  // namespace

StiffeningLaw stiffening_law(const Material& material) {
    if (!material.stiffening) return {};
    StiffeningLaw law = std::visit(
        [&](const auto& kind) { return law_of(kind, material.shear_modulus_pa); },
        *material.stiffening);
    if (law.pole != 0) law.straight_from = largest_share_of_limit * law.limit;
    return law;
}

Stiffening1D stiffening_at(const StiffeningLaw& law, double s) {
    const double inside = std::min(s, law.straight_from);
    const double over = s - inside;
    const double room = 1 / (law.limit - inside);
    double value = 0, slope = 0, integral = 0;
    for (int k = stiffening_coefficients - 1; k >= 0; --k) {
        slope = slope * inside + value;
        value = value * inside + law.coefficient[k];
        integral = integral * inside + law.coefficient[k] / (k + 1);
    }
    value += law.pole * room;
    slope += law.pole * room * room;
    integral = integral * inside - law.pole * std::log1p(-inside / law.limit);
    return {value + slope * over, slope, integral + over * (value + 0.5 * slope * over)};
}

Distortion distortion(const ElementReference& reference, const Material& material,
                      const Positions8& x_m) {
    const double scale = material.shear_modulus_pa * reference.volume;  // G V0
    Distortion out;
    out.unscaled_n = material.shear_modulus_pa * reference.spring_matrix * x_m;
    double energy = 0.5 * out.unscaled_n.cwiseProduct(x_m).sum();
    if (reference.variant == ElementVariant::assumed_strain) {
        const HourglassState hourglass =
            hourglass_energy(reference.hourglass, material, x_m);
        energy += hourglass.energy_j;
        out.unscaled_n += hourglass.gradient_n;
    }
    const double s = 2 * energy / scale - 3;
    const StiffeningLaw law = stiffening_law(material);
    out.law = stiffening_at(law, s);
    out.share = s / law.limit;
    out.energy_j = 0.5 * scale * out.law.integral;
    out.gradient_n = out.law.factor * out.unscaled_n;
    return out;
}

Matrix24 stiffening_tangent(const ElementReference& reference, const Material& material,
                            const Distortion& state, const Matrix24& hourglass) {
    const Eigen::Vector<double, 24> slope = state.unscaled_n.reshaped<Eigen::RowMajor>();
    const double rest = state.law.factor - 1;
    Matrix24 out = rest * hourglass;
    const double curvature =
        2 * state.law.slope / (material.shear_modulus_pa * reference.volume);
    out.noalias() += (curvature * slope) * slope.transpose();
    const Matrix8 springs = rest * material.shear_modulus_pa * reference.spring_matrix;
    for (int b = 0; b < 8; ++b) {
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) out(3 * a + d, 3 * b + d) += springs(a, b);
        }
    }
    return out;
}

}  // namespace magfsi::structure
