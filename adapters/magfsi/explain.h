// magfsi explain: what a scene will do, before it does it.
#pragma once

#include <string>

#include "coupler/scene/scene.h"

namespace magfsi::launch {

// Effects in step order and those absent; SI and lattice values side by side; memory.
std::string explain(const scene::Scene& scene);

}  // namespace magfsi::launch
