// SPDX-License-Identifier: GPL-2.0-or-later
// What the scene's fluid becomes on the lattice, as a table, and what to mind of it.
#pragma once

#include <string>

#include "adapters/scene/scene.h"
#include "fluid_lbm/config.h"

namespace magfsi::lbm {

struct LatticeValues {
    double spacing_m, step_s, tau, mach = 0, grid_reynolds = 0, speed = 0;
    double odd_rate = 1;                         // of trt
    double quickest_1_s = 0, quickest_m2_s = 0;  // largest rate of shear, viscosity there
};

LatticeValues lattice_values(const scene::Fluid& fluid, const fluid::FluidConfig& config);

std::string table(const scene::Fluid& fluid, const LatticeValues& v);

// Each with what to take.
std::string warnings(const scene::Scene& scene, const LatticeValues& v);

// Of inlets with a course: how little the lattice follows as an incompressible fluid does
// (docs/howto/obstacle.md), from the start and afterwards.
std::string sound(const scene::Fluid& fluid, const LatticeValues& v);

}  // namespace magfsi::lbm
