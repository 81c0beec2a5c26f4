// The fluid's columns of probes.csv.
#pragma once

#include <string>
#include <vector>

#include "coupler/scene/scene.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

std::vector<double> probe_values(const std::vector<scene::FluidQuantity>& quantities,
                                 const fluid::Fluid& fluid);  // collective

}  // namespace magfsi::lbm
