// SPDX-License-Identifier: GPL-2.0-or-later
// SI to lattice units and back: length in cells, time in steps, density 1 at rest.
#pragma once

namespace magfsi::fluid {

struct Units {
    double spacing_m = 0;
    double time_step_s = 0;
    double density_kg_m3 = 0;

    // One lattice unit of each in SI.
    double velocity_m_s() const { return spacing_m / time_step_s; }
    double force_n_m3() const {
        return density_kg_m3 * spacing_m / (time_step_s * time_step_s);
    }
    double cell_mass_kg() const {
        return density_kg_m3 * spacing_m * spacing_m * spacing_m;
    }
    // Pressure per unit of density - 1: the speed of sound squared is 1/3.
    double pressure_pa() const {
        return density_kg_m3 * velocity_m_s() * velocity_m_s() / 3;
    }
};

// tau = 3 nu dt / dx^2 + 1/2.
constexpr double relaxation_time(double viscosity_m2_s, double time_step_s,
                                 double spacing_m) {
    return 3 * viscosity_m2_s * time_step_s / (spacing_m * spacing_m) + 0.5;
}

// From here on the automatic collision is trt, with a magic number of 3/16. Nearer to 1/2
// its odd rate vanishes if Lambda stays there (0.24 at 0.55, 0.018 at 0.5035, 0.008 at
// 0.5015): a swimming robot and a Taylor-Green vortex diverged.
constexpr double trt_from = 0.55;

}  // namespace magfsi::fluid
