// Names of the columns of probes.csv beside those of the bodies (adapters/bodies/probe_row.h),
// in the order in which their values are delivered.
#pragma once

#include <string>
#include <vector>

#include "adapters/scene/scene.h"

namespace magfsi::scene {

std::vector<std::string> fluid_columns(const Scene& scene);
std::vector<std::string> interface_columns(const Scene& scene);

}  // namespace magfsi::scene
