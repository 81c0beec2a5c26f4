// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of equal cubes: those cubes of a grid that are filled.
#pragma once

#include <array>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Largest share of all cubes in parts that no face joins to the largest part; such
// crumbs, at a tip or along an edge thinner than a cube, are left out.
constexpr double most_crumbs = 0.01;

// Mesh of the cubes whose entry in `filled` is not 0. filled: one entry per cell in the
// order of box_mesh's elements, x fastest. The origin is the grid's lowest corner. Faces
// "x_min" to "z_max" are the nodes that lie farthest out. Throws std::invalid_argument if
// no cube is filled, or if there are several parts of more than crumbs.
Mesh voxel_mesh(const std::array<int, 3>& cells, double spacing_m,
                const std::vector<char>& filled);

}  // namespace magfsi::structure
