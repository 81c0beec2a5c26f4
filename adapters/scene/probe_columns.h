// Names of the columns of probes.csv, in the order in which both sides deliver values.
#pragma once

#include <string>
#include <vector>

#include "adapters/scene/scene.h"

namespace magfsi::scene {

std::vector<std::string> body_columns(const Scene& scene);   // structure side
std::vector<std::string> fluid_columns(const Scene& scene);  // fluid side
std::vector<std::string> interface_columns(const Scene& scene);

}  // namespace magfsi::scene
