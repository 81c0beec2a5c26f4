// SPDX-License-Identifier: GPL-2.0-or-later
// Parts of a body by shapes in its own frame.
#pragma once

#include <span>

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// True for points in each shape that is given: a box or a ball (bounds included), the
// inside of a polygon in the x-y plane by the even-odd rule.
bool holds(const RegionShape& shape, const Vec3& point_m);

// Name of the region of those elements of a mesh without regions that lie in none of the
// shapes.
constexpr const char* rest_of_mesh = "rest";

// Gives elements whose centre lies in a shape that shape's region; the first one wins.
// All others keep the region that they have, or become the rest. Throws
// std::invalid_argument if a name is taken or a region holds no element.
void add_regions(Mesh& mesh, std::span<const NamedRegion> regions);

}  // namespace magfsi::structure
