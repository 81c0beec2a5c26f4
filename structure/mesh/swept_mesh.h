// SPDX-License-Identifier: GPL-2.0-or-later
// Blocks bent or wound along a curve: arcs, rings, helices. Sections are plane and across
// the curve, their middles on it, so that the volume is that of the block.
#pragma once

#include <numbers>

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// In the plane xz about the origin, its middle at z = -radius and both ends up; the width
// is along y, local z towards the centre: a block along x whose ends have been bent up.
// Nodes, elements, faces and the centre line are those of box_mesh; of a ring the last
// nodes are the first, and it has neither x_min nor x_max. Throws std::invalid_argument
// where a size or a count is not positive, where the thickness reaches to the centre, or
// with fewer than eight elements a turn.
Mesh arc_mesh(const Arc& arc);
inline bool is_ring(const Arc& arc) {
    return arc.angle_rad > 2 * std::numbers::pi * (1 - 1e-9);
}

// About the axis x: (c t, R cos t, R sin t), c = pitch / 2 pi, t from 0 to 2 pi turns;
// left-handed: sin t with the other sign. Local z points away from the axis, the width
// lies along the cylinder. Throws as arc_mesh, and where turns touch each other.
Mesh helix_mesh(const Helix& helix);

// The block that the body was before it was bent.
Box straightened(const Arc& arc);
Box straightened(const Helix& helix);

}  // namespace magfsi::structure
