// SPDX-License-Identifier: GPL-2.0-or-later
// The columns of probes.csv that a fluid fills. The name of a column and its value come
// from one entry of fluid_probes.cpp.
#pragma once

#include <string>
#include <vector>

#include "adapters/solvers/fluids/fluid_solver.h"

namespace magfsi::fluids {

// Names of the fluid's columns with their units, such as "mass[kg]"; empty if the scene
// has no fluid or no probes of it.
std::vector<std::string> fluid_columns(const scene::Scene& scene);

// Names of the columns that probes.interface_balance adds: the relative mismatch of
// momentum and power between what the bodies gave and the fluid received (Mismatch in
// coupler/immersed_boundary/balance.h), and the impulse [N s] that the fluid received
// since the last row. Empty if the scene does not ask for them.
std::vector<std::string> interface_columns(const scene::Scene& scene);

// Values of fluid_columns() at the present step, one per column, on every rank.
// Collective over the fluid's ranks.
std::vector<double> fluid_values(const scene::Scene& scene, FluidSolver& fluid);

}  // namespace magfsi::fluids
