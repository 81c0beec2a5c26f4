// SPDX-License-Identifier: GPL-2.0-or-later
// Parts of a uniform grid in global indices of cells, by which fluids and the coupling
// tell each other where values belong. Both sides include this header, and neither the
// other.
#pragma once

#include <array>

namespace magfsi {

// Half-open box of cells: lo <= index < hi along x, y, z.
struct CellBox {
    std::array<int, 3> lo{}, hi{};
    bool operator==(const CellBox&) const = default;
};

// Cells x_begin <= x < x_end of one row along x.
struct CellRow {
    int y = 0, z = 0, x_begin = 0, x_end = 0;
    int size() const { return x_end - x_begin; }
};

}  // namespace magfsi
