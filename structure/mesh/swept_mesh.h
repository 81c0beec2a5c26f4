// SPDX-License-Identifier: GPL-2.0-or-later
// Blocks bent or wound along a curve: arcs, rings, helices. Sections are plane and
// perpendicular to the curve, with their middles on it, so that the volume is that of the
// straight block.
#pragma once

#include <numbers>

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// Arc in the plane xz about the origin, with its middle at z = -radius and both ends up:
// a block along x whose ends have been bent up. The width is along y, local z points
// towards the centre. Nodes, elements, faces and centre line are those of box_mesh; in a
// ring the last nodes are the first, and there is neither x_min nor x_max. Throws
// std::invalid_argument if a size or a number of elements is not positive, if the
// thickness reaches to the centre, or with fewer than eight elements per turn.
Mesh arc_mesh(const Arc& arc);
// True if the arc is a full turn, up to rounding.
inline bool is_ring(const Arc& arc) {
    return arc.angle_rad > 2 * std::numbers::pi * (1 - 1e-9);
}

// Helix about the axis x: (c t, R cos t, R sin t) with c = pitch / 2 pi and t from 0 to 2
// pi turns; left-handed ones have -R sin t. Local z points away from the axis, the width
// lies along the cylinder. Throws as arc_mesh does, on a radius of 0, and if turns touch
// each other.
Mesh helix_mesh(const Helix& helix);

// The straight block with the same length and section.
Box straightened(const Arc& arc);
Box straightened(const Helix& helix);

}  // namespace magfsi::structure
