// SPDX-License-Identifier: GPL-2.0-or-later
// The scene's fluid in the terms of fluid_lbm/.
#pragma once

#include "adapters/scene/scene.h"
#include "fluid_lbm/fluid.h"
#include "fluid_lbm/refinement/refined_fluid.h"

namespace magfsi::lbm {

// Of a refined grid, the coarsest level's.
fluid::FluidConfig to_config(const scene::Scene& scene, double coupled_step_s);

// Of a scene with fluid.refinement.
fluid::RefinedConfig to_refined_config(const scene::Scene& scene, double coupled_step_s);
// What the finest level is to be around: the given box, or each body where it starts
// (before it relaxes).
std::vector<fluid::BodyBox> refined_parts_m(const scene::Scene& scene);

// The grids of each level at the start: one, or with fluid.refinement the finer levels'
// patches behind it.
using LevelConfigs = std::vector<std::vector<fluid::FluidConfig>>;
LevelConfigs level_configs(const scene::Scene& scene);
double cells_of(const std::vector<fluid::FluidConfig>& level);
// Cells that a coupled step updates, in the mean.
double updated_cells(const LevelConfigs& levels);

}  // namespace magfsi::lbm
