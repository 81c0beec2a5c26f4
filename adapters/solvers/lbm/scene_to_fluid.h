// SPDX-License-Identifier: GPL-2.0-or-later
// Translates a scene's fluid into the configurations of fluid_lbm/.
#pragma once

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "fluid_lbm/fluid.h"
#include "fluid_lbm/refinement/refined_fluid.h"

namespace magfsi::lbm {

// Configuration of the uniform grid, or of the coarsest level of a refined one.
// coupled_step_s: the coupled step [s], which is the step of the finest level.
fluid::FluidConfig to_config(const scene::Scene& scene, double coupled_step_s);

// Configuration of all levels, for a scene with fluid.refinement.
fluid::RefinedConfig to_refined_config(const scene::Scene& scene, double coupled_step_s);
// Boxes [m] around the bodies at their start. A body that starts relaxed is taken in its
// flat shape.
std::vector<fluid::BodyBox> boxes_of_bodies_m(const scene::Scene& scene,
                                              const bodies::Solids& solids);
// Boxes [m] that the finest level is placed around: the box that the scene gives, or
// those of the bodies.
std::vector<fluid::BodyBox> refined_parts_m(const scene::Scene& scene,
                                            const bodies::Solids& solids);

// Configurations of the grids at the start, by level, the coarsest first; a finer level
// has one for each of its patches. Without fluid.refinement there is one level with one
// grid.
using LevelConfigs = std::vector<std::vector<fluid::FluidConfig>>;
LevelConfigs level_configs(const scene::Scene& scene, const bodies::Solids& solids);
// Number of cells of all grids of a level.
double cells_of(const std::vector<fluid::FluidConfig>& level);
// Mean number of cells that a coupled step updates: a level takes half as many steps as
// the next finer one.
double updated_cells(const LevelConfigs& levels);

}  // namespace magfsi::lbm
