// SPDX-License-Identifier: GPL-2.0-or-later
// The obstacle that each cell of a rank lies in. Lattice units.
#pragma once

#include <array>
#include <vector>

#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/obstacle/solid.h"

namespace magfsi::fluid {

// Largest number of cells of a rank along an axis: what CutLink::cell can hold.
inline constexpr int most_cells_along = 32767;

// Map of the obstacle that each cell of this rank, and of two layers around it, lies in.
// It is computed from the geometry alone, without messages between ranks.
class SolidMap {
  public:
    static constexpr int fluid = -1;  // obstacle() of a cell in no obstacle

    // Marks the cells of a box of global cells. A cell belongs to the first obstacle that
    // holds its centre. Cells beyond a periodic side are those of the opposite end; cells
    // beyond another side count as fluid.
    SolidMap(const FluidConfig& config, const Solids& solids, const CellBox& owned);

    // Number of the obstacle that holds a cell, or `fluid`. Local indices from -margin to
    // the number of owned cells plus margin - 1.
    int obstacle(const Cell& local) const { return of_cell_[index(local)]; }
    bool solid(const Cell& local) const { return obstacle(local) != fluid; }

    // Global indices of a cell, wrapped around periodic axes.
    Cell global(const Cell& local) const;
    // True if the cell lies in the box, after wrapping.
    bool in_box(const Cell& local) const;
    // Number of this rank's cells in each obstacle.
    const std::vector<long long>& cell_counts() const { return cell_counts_; }
    // True if a row of this rank or of the layer around it, or one of the eight beside
    // that row, has a solid cell.
    bool near_solid(int y, int z) const;

  private:
    static constexpr int margin = 2;  // layers around this rank's cells
    std::size_t index(const Cell& local) const {
        return row(local[1], local[2]) * (size_[0] + 2 * margin) + local[0] + margin;
    }
    std::size_t row(int y, int z) const {
        return static_cast<std::size_t>(z + margin) * (size_[1] + 2 * margin) + y +
               margin;
    }
    // Enters an obstacle's cells into the map.
    void mark(const Solid& solid, int number);

    // Box of this map; cells of the whole box.
    std::array<int, 3> origin_, size_, box_cells_;
    std::array<bool, 3> periodic_;
    // Obstacle of each cell, the margin included, x fastest.
    std::vector<short> of_cell_;
    std::vector<char> row_has_solid_;
    std::vector<long long> cell_counts_;
};

}  // namespace magfsi::fluid
