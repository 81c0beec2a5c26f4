// SPDX-License-Identifier: GPL-2.0-or-later
// The six sides of the box: their cells, their openings, and the flow through inlets. A
// side is 2 * axis at the low end and 2 * axis + 1 at the high end (0 x_min ... 5 z_max).
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "fluid_lbm/config.h"

namespace magfsi::fluid {

// Indices x, y, z of a cell.
using Cell = std::array<int, 3>;

// Axis that a side lies across.
inline int axis_of(int side) {
    return side / 2;
}
// The two axes in the plane of a side, in the order x, y, z.
inline std::array<int, 2> in_plane(int side) {
    return {axis_of(side) == 0 ? 1 : 0, axis_of(side) == 2 ? 1 : 2};
}
// Sign of the velocity, along the side's axis, of populations that enter by the side.
inline int inward(int side) {
    return side % 2 == 0 ? 1 : -1;
}

// This rank's cells at a side, in local indices; absent if its box does not reach the
// side.
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

// Calls use(cell) for all cells of a box, x fastest.
template <class Use>
void for_each_cell(const CellBox& box, Use&& use) {
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            for (int x = box.lo[0]; x < box.hi[0]; ++x) use(Cell{x, y, z});
        }
    }
}

// True if a cell at a side is open. At an inlet it is if the opening has a part of the
// cell's face, at an outlet if it has the face's centre; without an opening all cells
// are. cell: global indices.
bool is_open(const FluidConfig& config, int side, const Cell& cell);
// True if a side's opening holds the centre of the cell's face. cell: global indices.
bool holds_centre(const FluidConfig& config, int side, const Cell& cell);

// Area [m2] of the side's opening, or of the whole side.
double opening_area_m2(const FluidConfig& config, int side);
// Volume flow [m3/s] that an inlet is asked to bring into the box, and brings on the
// grid; 0 for other sides. The course over time is left out.
double inflow_m3_s(const FluidConfig& config, int side);

// Velocity [cells per step] of an inlet, without its course over time, as a function of
// an open cell (global indices): the mean over the cell's face. config must have been
// accepted by check_sides() and outlive the function.
std::function<Vec3(const Cell&)> inlet_velocity(const FluidConfig& config, int side);

// Throws std::invalid_argument with a sentence on the first side that cannot run.
void check_sides(const FluidConfig& config);

}  // namespace magfsi::fluid
