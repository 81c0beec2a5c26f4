// SPDX-License-Identifier: GPL-2.0-or-later
// Conversion of a fluid's state to another time step on the same cells.
//
// In lattice units a speed is u dt / dx, and the density excess of a pressure goes with
// (dt / dx)^2. The second moment of the populations' non-equilibrium part is the viscous
// stress, - 2/3 rho tau S with the rate of strain S in lattice units (Chapman, Enskog),
// so that it goes with tau dt: the same rule as between the grids of a refined lattice
// (Dupuis, Chopard, Phys. Rev. E 67, 066707, 2003; Lagrava et al., J. Comput. Phys. 231,
// 4808, 2012). Populations are rebuilt from these three alone (Latt, Chopard, Math.
// Comput. Simul. 72, 165, 2006): their other moments have no meaning beyond a step, and
// they grow first in a run that diverges.
#pragma once

#include <array>
#include <span>

#include "base/vector/vec3.h"
#include "fluid_lbm/config.h"

namespace magfsi::fluid {

// Factors between the old and the new state in lattice units.
struct StepChange {
    double velocity = 1;  // new time step over the old one
    double stress = 1;    // new tau dt over the old one
    double trace = 1;     // of the stress: factor beside `stress`
    // Change of momentum: populations lack half a step of the body force (Guo), and that
    // half changes with the step.
    Vec3 momentum{};
};

// The change from a time step of old_step_s to that of config. The relaxation times are
// those without eddy viscosity, which adapts within a few steps.
StepChange step_change(const FluidConfig& config, double old_step_s);

// Converts populations in place. values: 19 per cell, those that have arrived, as
// deviations from rest.
void change_step(const StepChange& change, std::span<double> values);

}  // namespace magfsi::fluid
