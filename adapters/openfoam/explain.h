// SPDX-License-Identifier: GPL-2.0-or-later
// What `magfsi explain` says of this fluid.
#pragma once

#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::openfoam {

// Cells, step, Courant number, memory. Throws std::invalid_argument on what the solver
// refuses.
std::string explain(const scene::Scene& scene, int ranks);

// Why this build cannot run OpenFOAM, and what to do; empty when it can. Loads nothing.
std::string missing();

}  // namespace magfsi::openfoam
