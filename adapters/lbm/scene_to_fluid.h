// The scene's fluid in the terms of fluid_lbm/.
#pragma once

#include "adapters/scene/scene.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

fluid::FluidConfig to_config(const scene::Scene& scene, double time_step_s);

}  // namespace magfsi::lbm
