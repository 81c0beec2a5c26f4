// SPDX-License-Identifier: GPL-2.0-or-later
// The state of a fluid, taken over by one with another time step on the same cells.
//
// In lattice units a speed is u dt / dx, and the pressure's density (rho - 1) goes with
// (dt / dx)^2. Of the populations' non-equilibrium part the second moment is the viscous
// stress, - 2/3 rho tau S with the rate of strain S in lattice units (Chapman, Enskog),
// so it goes with tau dt: the same rule as between the grids of a refined lattice
// (Dupuis, Chopard, Phys. Rev. E 67, 066707, 2003; Lagrava et al., J. Comput. Phys. 231,
// 4808, 2012). Populations are rebuilt from these three alone (Latt, Chopard, Math.
// Comput. Simul. 72, 165, 2006): what else they carry has no meaning beyond its step, and
// is what grows first in a run that diverges.
#pragma once

#include <array>
#include <span>

#include "fluid_lbm/config.h"

namespace magfsi::fluid {

struct StepChange {
    double velocity = 1;  // new step over old one
    double stress = 1;    // new tau dt over the old one, each in lattice units
    // Populations lack half a step of the body force (Guo), which is shorter now.
    std::array<double, 3> momentum{};
};

// To the step of config. By its relaxation time without eddy viscosity, whose own part
// settles within a few steps.
StepChange step_change(const FluidConfig& config, double old_step_s);

// values: 19 per cell, those that have arrived, as deviations from rest.
void change_step(const StepChange& change, std::span<double> values);

}  // namespace magfsi::fluid
