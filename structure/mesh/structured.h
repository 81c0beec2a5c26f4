// Meshes whose nodes form a grid of nx x ny x nz elements, whatever their positions.
#pragma once

#include <array>
#include <functional>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

using GridCounts = std::array<int, 3>;  // elements along the three grid directions

// Node (i, j, k) has the number i + (nx+1) (j + (ny+1) k) and lies at position(i, j, k);
// elements likewise. Fills the six faces ("x_min": i = 0 ...) and the centre line: one
// point a node column along i, in the middle of the other two directions. Throws
// std::invalid_argument where a count is below 1 or there are more nodes than an int
// counts.
Mesh structured_mesh(const GridCounts& elements,
                     const std::function<Vec3(int i, int j, int k)>& position);

// The point at grid coordinates s, in element edges: 0 to nx ...; coordinates outside are
// drawn to the grid's surface. A point on a border belongs to the higher element.
MaterialPoint structured_point(const GridCounts& elements, const Vec3& s);

}  // namespace magfsi::structure
