// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/obstacle/solid_map.h"

#include <algorithm>

#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

SolidMap::SolidMap(const FluidConfig& config, const Solids& solids, const CellBox& owned)
    : origin_(owned.lo), box_cells_(config.cells), periodic_(periodic_axes(config)) {
    for (int a = 0; a < 3; ++a) {
        size_[a] = owned.hi[a] - owned.lo[a];
        if (size_[a] > most_cells_along)
            refuse(size_[a], " cells of a rank along ", axis_name[a],
                   " found beside obstacles; at most ", most_cells_along,
                   ": take a larger spacing");
    }
    const std::size_t rows = row(-margin, size_[2] + margin);
    of_cell_.assign(rows * (size_[0] + 2 * margin), fluid);
    row_has_solid_.assign(rows, 0);
    for (std::size_t i = 0; i < solids.size(); ++i) mark(*solids[i], static_cast<int>(i));
    cell_counts_.resize(solids.size());
    for_each_cell({{0, 0, 0}, size_}, [&](const Cell& cell) {
        if (solid(cell)) ++cell_counts_[obstacle(cell)];
    });
}

Cell SolidMap::global(const Cell& local) const {
    Cell cell;
    for (int a = 0; a < 3; ++a) {
        cell[a] = origin_[a] + local[a];
        if (periodic_[a]) cell[a] = (cell[a] + box_cells_[a]) % box_cells_[a];
    }
    return cell;
}

bool SolidMap::in_box(const Cell& local) const {
    const Cell cell = global(local);
    for (int a = 0; a < 3; ++a) {
        if (cell[a] < 0 || cell[a] >= box_cells_[a]) return false;
    }
    return true;
}

void SolidMap::mark(const Solid& solid, int number) {
    const Bounds box{{0, 0, 0},
                     {1.0 * box_cells_[0], 1.0 * box_cells_[1], 1.0 * box_cells_[2]}};
    const std::vector<Bounds> parts = solid.parts_in(box);
    std::vector<char> inside(box_cells_[0]);
    for (int z = -margin; z < size_[2] + margin; ++z) {
        for (int y = -margin; y < size_[1] + margin; ++y) {
            const Cell at = global({0, y, z});
            const bool reached =
                in_box({0, y, z}) && std::ranges::any_of(parts, [&](const Bounds& part) {
                    return at[1] + 1 > part.low[1] && at[1] < part.high[1] &&
                           at[2] + 1 > part.low[2] && at[2] < part.high[2];
                });
            if (!reached) continue;
            inside.assign(inside.size(), 0);
            solid.mark_row(at[1] + 0.5, at[2] + 0.5, 0, inside);
            for (int x = -margin; x < size_[0] + margin; ++x) {
                if (!in_box({x, y, z}) || !inside[global({x, y, z})[0]]) continue;
                short& owner = of_cell_[index({x, y, z})];
                if (owner == fluid) owner = static_cast<short>(number);
                row_has_solid_[row(y, z)] = 1;
            }
        }
    }
}

bool SolidMap::near_solid(int y, int z) const {
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            if (row_has_solid_[row(y + dy, z + dz)]) return true;
        }
    }
    return false;
}

}  // namespace magfsi::fluid
