// SPDX-License-Identifier: GPL-2.0-or-later
// The part of `magfsi explain` about bodies: elements and their discretisation error,
// supports, loads, markers and time steps.
#pragma once

#include <string>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"

namespace magfsi::launch {

// Throws std::invalid_argument on faults that show only in the meshes, as the run would.
std::string explain_structure(const scene::Scene& scene, const bodies::Solids& solids);

}  // namespace magfsi::launch
