// How many MPI ranks a scene's participants get.
#pragma once

#include <map>
#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

using Ranks = std::map<std::string, int>;  // by role: structure, fluid

// "structure=1,fluid=2". Throws std::invalid_argument.
Ranks parse_ranks(const std::string& text);

// "structure=1,fluid=2", as --ranks takes it.
std::string to_text(const Ranks& ranks);

// Of each participant that the scene has: as given, or what the cores and the number of
// cells make of it. Throws std::invalid_argument if one is given that the scene lacks.
Ranks choose_ranks(const scene::Scene& scene, const Ranks& given);

}  // namespace magfsi::launch
