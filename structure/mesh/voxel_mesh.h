// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of equal cubes, those of a grid that something fills.
#pragma once

#include <array>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Cubes that no face joins to the largest part are left out where they are at most this
// share of all: crumbs at a tip or along an edge that is thinner than a cube.
constexpr double most_crumbs = 0.01;

// The cubes for which filled holds, in the order of box_mesh's elements. The frame is
// the grid's; faces "x_min" to "z_max" are the nodes that lie furthest out. Throws
// std::invalid_argument where nothing is filled, or several parts.
Mesh voxel_mesh(const std::array<int, 3>& cells, double spacing_m,
                const std::vector<char>& filled);

}  // namespace magfsi::structure
