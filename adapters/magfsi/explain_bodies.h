// SPDX-License-Identifier: GPL-2.0-or-later
// What explain tells of the bodies: elements, what they do to the displacements, what
// holds and loads each, markers, steps.
#pragma once

#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

// Throws std::invalid_argument as the run would, of what is known only with the meshes.
std::string explain_structure(const scene::Scene& scene);

}  // namespace magfsi::launch
