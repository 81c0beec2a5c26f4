// Plate of parallelogram cells: the crease pattern of Miura-ori, in the flat state, or a
// sheared block. Mesh lines follow the cells' borders, so that magnetic domains end where
// elements end.
#pragma once

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// Cell (row, column) has its sides along x (length_a) and at `angle` to x (length_b). In
// a zigzag the rows lean to the right and to the left in turn, the first one to the right
// for angles below 90 degrees; without, all lean alike.
//
//      /____/____/      row 2
//      \____\____\      row 1
//      /____/____/      row 0
//
// The plate's lowest y and z are 0 and its lower left corner is at x = 0. Each cell is a
// region, "row R column C" from 0, numbered row by row; faces are named as those of
// box_mesh, x_min and x_max being the oblique ones. Throws std::invalid_argument on
// counts, lengths or angles that are not allowed.
Mesh oblique_mesh(const ObliquePlate& plate);

}  // namespace magfsi::structure
