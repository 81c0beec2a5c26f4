// SPDX-License-Identifier: GPL-2.0-or-later
// What `magfsi explain` says of this fluid.
#pragma once

#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::lbm {

// SI and lattice values side by side, the collision and why, warnings with the values to
// use instead, memory on so many ranks. Throws std::invalid_argument on what the solver
// refuses.
std::string explain(const scene::Scene& scene, int ranks);

}  // namespace magfsi::lbm
