// SPDX-License-Identifier: GPL-2.0-or-later
// The part of `magfsi explain` that concerns the lattice-Boltzmann fluid.
#pragma once

#include <string>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"

namespace magfsi::lbm {

// A text for the terminal: SI and lattice values side by side, the chosen collision and
// the reason, warnings with the values to use instead, and the memory needed on `ranks`
// ranks. Throws std::invalid_argument on what the solver refuses.
std::string explain(const scene::Scene& scene, const bodies::Solids& solids, int ranks);

}  // namespace magfsi::lbm
