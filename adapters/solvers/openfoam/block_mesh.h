// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>
#include <string>

#include "adapters/scene/scene.h"
#include "adapters/solvers/openfoam/obstacles.h"

namespace magfsi::openfoam {

// Text of blockMeshDict: the box with the cells of `mesh`, in as many blocks as the boxes
// that the plan cuts out need. patch(side) is the entry of a side's patch.
std::string block_mesh(const scene::Fluid& fluid, const BoxMesh& mesh,
                       const ObstaclePlan& plan,
                       const std::function<std::string(std::size_t side)>& patch);

}  // namespace magfsi::openfoam
