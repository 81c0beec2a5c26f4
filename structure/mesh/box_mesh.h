// Block of bricks, origin in its lowest corner.
#pragma once

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// Node (i, j, k) has the number i + (nx+1) (j + (ny+1) k); element likewise. Fills the
// six faces and the centre line (one point a node column along x, at half width and
// thickness).
Mesh box_mesh(const Box& box);

// The element that holds a point of the undeformed block, and its trilinear weights.
// Points outside are drawn to the surface.
MaterialPoint locate(const Box& box, const Vec3& point_m);

}  // namespace magfsi::structure
