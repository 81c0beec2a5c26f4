// SPDX-License-Identifier: GPL-2.0-or-later
// The six sides of the box: their cells, their openings, and the flow through inlets.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "fluid_lbm/config.h"

namespace magfsi::fluid {

using Cell = std::array<int, 3>;

// Of side 2 * axis (low) or 2 * axis + 1.
inline int axis_of(int side) {
    return side / 2;
}
// The two other axes, in the order x, y, z.
inline std::array<int, 2> in_plane(int side) {
    return {axis_of(side) == 0 ? 1 : 0, axis_of(side) == 2 ? 1 : 2};
}
// Component along the axis of populations that enter by the side.
inline int inward(int side) {
    return side % 2 == 0 ? 1 : -1;
}

// This rank's cells at a side, in local indices; none if its box does not reach there.
inline std::optional<CellBox> cells_at_side(const CellBox& owned,
                                            const std::array<int, 3>& box_cells,
                                            int side) {
    const int axis = axis_of(side);
    const bool low = side % 2 == 0;
    if (low ? owned.lo[axis] != 0 : owned.hi[axis] != box_cells[axis]) return {};
    CellBox cells;
    for (int a = 0; a < 3; ++a) cells.hi[a] = owned.hi[a] - owned.lo[a];
    (low ? cells.hi : cells.lo)[axis] = low ? 1 : cells.hi[axis] - 1;
    return cells;
}

// use(local cell) for all cells of the box, x fastest.
template <class Use>
void for_each_cell(const CellBox& box, Use&& use) {
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            for (int x = box.lo[0]; x < box.hi[0]; ++x) use(Cell{x, y, z});
        }
    }
}

// Whether an inlet's opening has a part of a cell's face on the side; an outlet's,
// whether it has the face's centre. True without an opening. Global indices.
bool is_open(const FluidConfig& config, int side, const Cell& cell);

// Of the opening, or the whole side.
double opening_area_m2(const FluidConfig& config, int side);
// Volume per time that an inlet is asked to bring into the box, and brings; 0 of other
// sides.
double inflow_m3_s(const FluidConfig& config, int side);

// Steady velocity [cells per step], the mean over its face, at the face of an inlet's
// open cell, global indices. Of an accepted configuration, which outlives the function.
std::function<Vec3(const Cell&)> inlet_velocity(const FluidConfig& config, int side);

// Throws std::invalid_argument with a sentence on the first side that cannot run.
void check_sides(const FluidConfig& config);

}  // namespace magfsi::fluid
