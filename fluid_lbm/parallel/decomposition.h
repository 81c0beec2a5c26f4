// SPDX-License-Identifier: GPL-2.0-or-later
// Decomposition of the box into one block per rank, cut along y and z; rows along x stay
// whole.
#pragma once

#include <array>
#include <vector>

#include "fluid_lbm/config.h"
#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

inline constexpr int no_rank = -1;  // no neighbour on that side

// The blocks of all ranks; the same object on each of them.
struct Decomposition {
    std::array<int, 3> cells{};  // number of cells of the whole box
    std::array<bool, 3> periodic{};
    std::array<int, 2> ranks{1, 1};  // number of blocks along y and z
    std::vector<CellBox> boxes;      // blocks by rank (y fastest), global indices

    // The rank beyond a side of a rank's box (axis: 1 y, 2 z; side: 0 low, 1 high);
    // no_rank at a wall of the domain and along an axis that is not cut.
    int neighbour(int rank, int axis, int side) const;
    // Rows of a rank's box, ghost rows included.
    RowLayout layout(int rank) const;
};

// Chooses the cut with the least work on the fullest rank. Work is counted in rows; a
// ghost row, which moves 5 of 19 populations there and back in two steps, counts as half
// a row. Blocks along an axis differ by one row at most. Throws std::invalid_argument if
// no cut gives every rank a row.
Decomposition decompose(const std::array<int, 3>& cells,
                        const std::array<bool, 3>& periodic, int ranks);

// The functions below order a rank's rows within a step: those at cut sides first, so
// that their populations travel while the others are computed.

// Rows y_begin <= y < y_end and z_begin <= z < z_end, in local indices.
struct RowBox {
    int y_begin = 0, y_end = 0, z_begin = 0, z_end = 0;
    int size() const { return (y_end - y_begin) * (z_end - z_begin); }
};

// Disjoint boxes of the rows that lie beside a neighbour's ghost row.
std::vector<RowBox> rows_at_cuts(const RowLayout& layout);
// All other rows, in two halves, one for each axis of the exchange; may be empty.
std::vector<RowBox> inner_rows(const RowLayout& layout);
// The parts of boxes inside another box, without empty ones.
std::vector<RowBox> clipped(std::vector<RowBox> boxes, const RowBox& to);

}  // namespace magfsi::fluid
