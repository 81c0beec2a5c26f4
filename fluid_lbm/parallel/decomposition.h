// SPDX-License-Identifier: GPL-2.0-or-later
// The box cut along y and z into one block per rank; rows along x stay whole.
#pragma once

#include <array>
#include <vector>

#include "fluid_lbm/config.h"
#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

inline constexpr int no_rank = -1;

struct Decomposition {
    std::array<int, 3> cells{};
    std::array<bool, 3> periodic{};
    std::array<int, 2> ranks{1, 1};  // along y and z
    std::vector<CellBox> boxes;      // by rank, y fastest

    // The rank beyond a side of a rank's box (axis 1 y, 2 z; side 0 low, 1 high), no_rank
    // if there is the domain's wall or the axis is not cut.
    int neighbour(int rank, int axis, int side) const;
    RowLayout layout(int rank) const;
};

// The cut with the least work on the fullest rank, counted in rows: a ghost row, which
// moves 5 of 19 populations there and back in two steps, as half a row. Blocks along an
// axis differ by one row at most. Throws std::invalid_argument if there are more ranks
// than any cut can give a row to.
Decomposition decompose(const std::array<int, 3>& cells,
                        const std::array<bool, 3>& periodic, int ranks);

// A rank's rows in the order of a step: those at cut sides first, so that their
// populations travel while the rest is computed.

// Rows y_begin <= y < y_end, z alike.
struct RowBox {
    int y_begin = 0, y_end = 0, z_begin = 0, z_end = 0;
    int size() const { return (y_end - y_begin) * (z_end - z_begin); }
};

// Disjoint boxes that cover the rows with a neighbour's ghost row beside them.
std::vector<RowBox> rows_at_cuts(const RowLayout& layout);
// All others, in two halves: one for each axis of the exchange. May be empty.
std::vector<RowBox> inner_rows(const RowLayout& layout);
// What boxes share with another one.
std::vector<RowBox> clipped(std::vector<RowBox> boxes, const RowBox& to);

}  // namespace magfsi::fluid
