// SPDX-License-Identifier: GPL-2.0-or-later
// Conversion between SI and lattice units: length in cells, time in steps, density
// relative to that at rest.
#pragma once

namespace magfsi::fluid {

// The three scales of a fluid; the functions give one lattice unit of a quantity in SI.
struct Units {
    double spacing_m = 0;
    double time_step_s = 0;
    double density_kg_m3 = 0;

    // Unit of velocity (a cell per step), of force density, and mass of a cell at rest.
    double velocity_m_s() const { return spacing_m / time_step_s; }
    double force_n_m3() const {
        return density_kg_m3 * spacing_m / (time_step_s * time_step_s);
    }
    double cell_mass_kg() const {
        return density_kg_m3 * spacing_m * spacing_m * spacing_m;
    }
    // Pressure [Pa] per unit of density - 1, as the lattice's speed of sound squared is
    // 1/3.
    double pressure_pa() const {
        return density_kg_m3 * velocity_m_s() * velocity_m_s() / 3;
    }
};

// Relaxation time in steps, tau = 3 nu dt / dx^2 + 1/2.
constexpr double relaxation_time(double viscosity_m2_s, double time_step_s,
                                 double spacing_m) {
    return 3 * viscosity_m2_s * time_step_s / (spacing_m * spacing_m) + 0.5;
}

}  // namespace magfsi::fluid
