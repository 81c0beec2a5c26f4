// The scene's fluid in the terms of fluid_lbm/.
#pragma once

#include "adapters/scene/scene.h"
#include "fluid_lbm/fluid.h"
#include "fluid_lbm/refinement/refined_fluid.h"

namespace magfsi::lbm {

fluid::FluidConfig to_config(const scene::Scene& scene, double time_step_s);

// Of a scene with fluid.refinement.
fluid::RefinedConfig to_refined_config(const scene::Scene& scene, double coupled_step_s);
// Lower and upper corner of what the finest level is to be around: the given box, or the
// bodies where they start (before they relax).
std::array<fluid::Vec3, 2> refined_part_m(const scene::Scene& scene);

}  // namespace magfsi::lbm
