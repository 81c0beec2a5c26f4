// SPDX-License-Identifier: GPL-2.0-or-later
// The part of `magfsi explain` about files that a scene names: extents and ranges as
// read, so that a file in a wrong unit is noticed.
#pragma once

#include <string>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"

namespace magfsi::launch {

// Reads meshes, surfaces, magnetisations, grids and tables. Returns "" for a scene that
// names no files. Throws std::invalid_argument or std::runtime_error for a file that
// cannot be read.
std::string explain_files(const scene::Scene& scene, const bodies::Solids& solids);

}  // namespace magfsi::launch
