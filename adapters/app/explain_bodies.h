// SPDX-License-Identifier: GPL-2.0-or-later
// The part of `magfsi explain` about bodies: elements and their discretisation error,
// supports, loads, markers and time steps.
#pragma once

#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

// Builds all meshes and throws std::invalid_argument on faults that show only then, as
// the run would.
std::string explain_structure(const scene::Scene& scene);

}  // namespace magfsi::launch
