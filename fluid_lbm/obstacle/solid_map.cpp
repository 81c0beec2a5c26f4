#include "fluid_lbm/obstacle/solid_map.h"

namespace magfsi::fluid {

SolidMap::SolidMap(const Solids& solids, const CellBox& owned,
                   const std::array<int, 3>& box_cells,
                   const std::array<bool, 3>& periodic)
    : origin_(owned.lo), box_cells_(box_cells), periodic_(periodic) {
    for (int a = 0; a < 3; ++a) size_[a] = owned.hi[a] - owned.lo[a];
    const std::size_t rows = static_cast<std::size_t>(size_[1] + 2) * (size_[2] + 2);
    of_cell_.assign(rows * (size_[0] + 2), fluid);
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
    const Bounds bounds = solid.bounds();
    std::vector<char> inside(box_cells_[0]);
    for (int z = -1; z <= size_[2]; ++z) {
        for (int y = -1; y <= size_[1]; ++y) {
            const Cell row = global({0, y, z});
            const bool reached = in_box({0, y, z}) && row[1] + 1 > bounds.low[1] &&
                                 row[1] < bounds.high[1] && row[2] + 1 > bounds.low[2] &&
                                 row[2] < bounds.high[2];
            if (!reached) continue;
            inside.assign(inside.size(), 0);
            solid.mark_row(row[1] + 0.5, row[2] + 0.5, 0, inside);
            for (int x = -1; x <= size_[0]; ++x) {
                if (!in_box({x, y, z}) || !inside[global({x, y, z})[0]]) continue;
                short& owner = of_cell_[index({x, y, z})];
                if (owner == fluid) owner = static_cast<short>(number);
                row_has_solid_[index({-1, y, z}) / (size_[0] + 2)] = 1;
            }
        }
    }
}

bool SolidMap::near_solid(int y, int z) const {
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            if (row_has_solid_[index({-1, y + dy, z + dz}) / (size_[0] + 2)]) return true;
        }
    }
    return false;
}

}  // namespace magfsi::fluid
