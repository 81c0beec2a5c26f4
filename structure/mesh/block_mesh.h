// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes whose nodes form a grid of nx x ny x nz elements: blocks of bricks, and plates
// of parallelogram cells.
#pragma once

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// Block of bricks. Node (i, j, k) has the number i + (nx+1) (j + (ny+1) k), elements
// likewise. The mesh has six faces ("x_min": i = 0 ...) and a centre line (one point per
// node column along x, at half width and thickness). Throws std::invalid_argument if a
// size or a number of elements is not positive or there are more nodes than an int
// counts; so does oblique_mesh.
Mesh box_mesh(const Box& box);

// The element that contains a point of the undeformed block, and the point's trilinear
// weights. Points outside are moved to the surface; a point on a border belongs to the
// higher element.
MaterialPoint locate(const Box& box, const Vec3& point_m);

// Plate of parallelogram cells: the crease pattern of Miura-ori before folding, or a
// sheared block. Mesh lines follow the cells' borders, so that magnetic domains end where
// elements end. In a zigzag the rows lean alternately to the right and to the left, the
// first one to the right for angles below 90 degrees; otherwise all lean alike.
//
//      /____/____/      row 2
//      \____\____\      row 1
//      /____/____/      row 0
//
// The plate's lowest y and z are 0, and its lower left corner is at x = 0. Each cell is a
// region, "row R column C" from 0, numbered row by row. Faces have the names of those of
// box_mesh; x_min and x_max are the oblique ones.
Mesh oblique_mesh(const ObliquePlate& plate);

}  // namespace magfsi::structure
