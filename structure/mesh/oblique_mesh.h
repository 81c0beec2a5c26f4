// Plate of parallelogram cells: the crease pattern of Miura-ori, in the flat state, or a
// sheared block. Mesh lines follow the cells' borders, so that magnetic domains end where
// elements end.
#pragma once

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Cell (row, column) has its sides along x (length_a) and at `angle` to x (length_b). In
// a zigzag the rows lean to the right and to the left in turn, the first one to the right
// for angles below 90 degrees; without, all lean alike.
//
//      /____/____/      row 2
//      \____\____\      row 1
//      /____/____/      row 0
struct ObliquePlate {
    int columns = 0;  // cells along x
    int rows = 0;     // cells along y
    double length_a_m = 0;
    double length_b_m = 0;
    double angle_rad = 0;  // between the two sides, above 0 and below 180 degrees
    double thickness_m = 0;
    std::array<int, 3> elements_per_cell{1, 1, 1};  // along a, along b, layers
    bool zigzag = true;
};

// The plate's lowest y and z are 0 and its lower left corner is at x = 0. Each cell is a
// region, "row R column C" from 0, numbered row by row; faces are named as those of
// box_mesh, x_min and x_max being the oblique ones. Throws std::invalid_argument on
// counts, lengths or angles that are not allowed.
Mesh oblique_mesh(const ObliquePlate& plate);

}  // namespace magfsi::structure
