// What the immersed boundary needs to know of a fluid: a uniform grid of cells with
// values at the cell centres, cut into one box a rank. SI.
#pragma once

#include <array>
#include <vector>

namespace magfsi::coupler {

using Vec3 = std::array<double, 3>;

// Half-open box of cells in global indices.
struct CellBox {
    std::array<int, 3> lo{}, hi{};
};

// Cells x_begin <= x < x_end of one row, global indices.
struct GridRow {
    int y = 0, z = 0, x_begin = 0, x_end = 0;
};

struct Grid {
    double spacing_m = 0;
    std::array<int, 3> cells{};
    std::array<bool, 3> periodic{};
    std::vector<CellBox> owned_by_rank;
    std::vector<GridRow> solid{};  // cells without fluid, of all ranks
};

}  // namespace magfsi::coupler
