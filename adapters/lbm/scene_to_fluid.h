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
// Lower and upper corner of what the finest level is to be around: the given box, or the
// bodies where they start (before they relax).
std::array<fluid::Vec3, 2> refined_part_m(const scene::Scene& scene);

// What each level has at the start: one, or with fluid.refinement the finer ones behind
// it.
std::vector<fluid::FluidConfig> level_configs(const scene::Scene& scene);
// Cells that a coupled step updates, in the mean.
double updated_cells(const std::vector<fluid::FluidConfig>& levels);

}  // namespace magfsi::lbm
