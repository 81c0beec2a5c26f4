// Which cells of this rank, and of the layer around it, lie in which obstacle. Computed
// from the geometry alone: ranks need not ask each other.
#pragma once

#include <vector>

#include "fluid_lbm/boundary/lattice_side.h"
#include "fluid_lbm/obstacle/solid.h"

namespace magfsi::fluid {

class SolidMap {
  public:
    static constexpr int fluid = -1;

    // A cell belongs to the first obstacle that holds its centre. Cells beyond a periodic
    // side are those of the opposite end; cells beyond another side count as fluid.
    SolidMap(const Solids& solids, const CellBox& owned,
             const std::array<int, 3>& box_cells, const std::array<bool, 3>& periodic);

    // Local indices from -1 to the number of owned cells: the obstacle, or `fluid`.
    int obstacle(const Cell& local) const { return of_cell_[index(local)]; }
    bool solid(const Cell& local) const { return obstacle(local) != fluid; }

    // Global indices of a cell, wrapped around periodic axes.
    Cell global(const Cell& local) const;
    // Whether the cell lies in the box, after wrapping.
    bool in_box(const Cell& local) const;
    // This rank's cells in each obstacle.
    const std::vector<long long>& cell_counts() const { return cell_counts_; }
    std::size_t bytes() const {
        return of_cell_.size() * sizeof(short) + row_has_solid_.size();
    }
    // Whether a row of this rank, or one beside it, has a solid cell.
    bool near_solid(int y, int z) const;

  private:
    std::size_t index(const Cell& local) const {
        return (static_cast<std::size_t>(local[2] + 1) * (size_[1] + 2) + local[1] + 1) *
                   (size_[0] + 2) +
               local[0] + 1;
    }
    void mark(const Solid& solid, int number);

    std::array<int, 3> origin_, size_, box_cells_;
    std::array<bool, 3> periodic_;
    std::vector<short> of_cell_;
    std::vector<char> row_has_solid_;
    std::vector<long long> cell_counts_;
};

}  // namespace magfsi::fluid
