// The box cut along y and z into one block a rank; rows along x stay whole.
#pragma once

#include <array>
#include <vector>

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/lattice/row_layout.h"

namespace magfsi::fluid {

inline constexpr int no_rank = -1;

struct Decomposition {
    std::array<int, 3> cells{};
    std::array<bool, 3> periodic{};
    std::array<int, 2> ranks{1, 1};  // along y and z
    std::vector<CellBox> boxes;      // by rank, y fastest

    // The rank beyond a side of a rank's box (axis 1 y, 2 z; side 0 low, 1 high), no_rank
    // if there is the domain's wall or the axis is not cut.
    int neighbor(int rank, int axis, int side) const;
    RowLayout layout(int rank) const;
};

// The cut with the least work on the fullest rank, counted in rows: a ghost row, which
// moves 5 of 19 populations there and back in two steps, as half a row. Blocks along an
// axis differ by one row at most. Throws std::invalid_argument if there are more ranks
// than any cut can give a row to.
Decomposition decompose(const std::array<int, 3>& cells,
                        const std::array<bool, 3>& periodic, int ranks);

}  // namespace magfsi::fluid
