// SPDX-License-Identifier: GPL-2.0-or-later
// How OpenFOAM's mesh fits the scene's obstacles: boxes whose faces are planes of the
// mesh are left out of it block by block, all others are cut out by snappyHexMesh.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/openfoam/engine/engine.h"

namespace magfsi::openfoam {

// A box between planes of the mesh, as indices of planes.
struct CutBox {
    std::size_t obstacle = 0;  // index in the scene
    std::array<int, 3> low{}, high{};

    bool holds(const std::array<int, 3>& cell) const {
        for (std::size_t d = 0; d < 3; ++d)
            if (cell[d] < low[d] || cell[d] >= high[d]) return false;
        return true;
    }
};

// The obstacles by the way in which they are cut out, as indices in the scene.
struct ObstaclePlan {
    std::vector<CutBox> cut;
    std::vector<std::size_t> snapped;
};

// Throws std::invalid_argument for an obstacle that is no body, lies outside the box, or
// crosses a periodic side.
ObstaclePlan plan_obstacles(const scene::Fluid& fluid, const BoxMesh& mesh);

// Name of an obstacle's patch: its own, unless a side of the box has that.
std::string patch_name(const scene::Obstacle& obstacle);

// A point in the fluid with cells of fluid around it, near an inlet if there is one:
// snappyHexMesh keeps what is connected with it. Throws std::invalid_argument if there is
// none.
scene::Vec3 point_in_fluid(const scene::Fluid& fluid);

// Throws std::invalid_argument if obstacles lie before the whole opening of an inlet.
// mesh: that of one rank.
void refuse_inlets_behind_obstacles(const scene::Fluid& fluid, const BoxMesh& mesh);

}  // namespace magfsi::openfoam
