// SPDX-License-Identifier: GPL-2.0-or-later
// The fluid's columns of probes.csv. A column's name and its value come from one entry of
// fluid_probes.cpp.
#pragma once

#include <string>
#include <vector>

#include "adapters/fluids/fluid_solver.h"

namespace magfsi::fluids {

// None for a scene without a fluid or its probes.
std::vector<std::string> fluid_columns(const scene::Scene& scene);

// Of probes.interface_balance: mismatch of what both sides gave and received, and the
// impulse that the fluid received since the last row.
std::vector<std::string> interface_columns(const scene::Scene& scene);

// Of the present step, one for each column. Collective.
std::vector<double> fluid_values(const scene::Scene& scene, FluidSolver& fluid);

}  // namespace magfsi::fluids
