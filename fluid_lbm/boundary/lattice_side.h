// A side of the box in lattice units, as the solver takes it.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/options.h"

namespace magfsi::fluid {

using Cell = std::array<int, 3>;

// Global cell indices throughout. Whether a side is periodic is the axis's affair
// (SolverConfig::periodic).
struct LatticeSide {
    BoundaryKind kind = BoundaryKind::no_slip;
    std::function<bool(const Cell&)> open;  // absent: the whole side
    // Inlets: steady velocity of a face times a factor of time, or a course of its own.
    // Time in steps.
    std::function<Vec3(const Cell&)> velocity;
    std::function<double(double time)> factor;
    std::function<Vec3(const Cell&, double time)> course;
    double density_excess = 0;  // outlets: target density - 1
};

// Of side 2 * axis (low) or 2 * axis + 1.
inline int axis_of(int side) {
    return side / 2;
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

}  // namespace magfsi::fluid
