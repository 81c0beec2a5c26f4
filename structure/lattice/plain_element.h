// SPDX-License-Identifier: GPL-2.0-or-later
// Energy and forces of one element in the plainest form: reference for tests and timings
// of the fast kernels, and source of energy densities for output.
#pragma once

#include <cmath>

#include "structure/lattice/element.h"
#include "structure/lattice/stiffening.h"

namespace magfsi::structure {

// Energy and forces of an element at given positions.
struct ElementState {
    double energy_j = 0;      // zero at rest
    double volume_ratio = 0;  // J
    Positions8 force_n;       // -dE/dx_a
};

// Energy of eq. (1), or with the material's stiffening, its derivative and J. x_m:
// present positions of the nodes.
inline ElementState element_energy(const ElementReference& reference,
                                   const Material& material, const Positions8& x_m) {
    const double g = material.shear_modulus_pa;
    const double k = material.lame_lambda_pa;
    const double v0 = reference.volume;
    // Springs depend on differences only. Without the mean, rounding does not grow with
    // the body's distance from the origin.
    const Positions8 x = x_m.rowwise() - x_m.colwise().mean();
    const Positions8 spring_force = -g * reference.spring_matrix * x;
    const VolumeAndGradient v = element_volume(reference, x);
    ElementState out;
    out.volume_ratio = v.volume_m3 / v0;
    const double log_j = std::log(out.volume_ratio);
    const double pressure = (k * log_j - g) / out.volume_ratio;  // dU/dJ [Pa]
    if (stiffens(material)) {
        const Distortion distorted = distortion(reference, material, x);
        out.energy_j = distorted.energy_j + v0 * log_j * (0.5 * k * log_j - g);
        out.force_n = -distorted.gradient_n - pressure * v.gradient_m2;
        return out;
    }
    out.energy_j = -0.5 * spring_force.cwiseProduct(x).sum() - 1.5 * g * v0 +
                   v0 * log_j * (0.5 * k * log_j - g);
    out.force_n = spring_force - pressure * v.gradient_m2;
    if (reference.variant == ElementVariant::assumed_strain) {
        const HourglassState hourglass =
            hourglass_energy(reference.hourglass, material, x);
        out.energy_j += hourglass.energy_j;
        out.force_n -= hourglass.gradient_n;
    }
    return out;
}

}  // namespace magfsi::structure
