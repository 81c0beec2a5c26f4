// SPDX-License-Identifier: GPL-2.0-or-later
// Obstacles in the flow: what they do after each step, and the force on them. Lattice
// units.
//
// The sweep knows nothing of them: solid cells hold rest and collide as if they were
// fluid. Afterwards the populations that would have come out of a solid cell are replaced
// by those that the wall returns, and the solid cells are set back to rest.
#pragma once

#include <mpi.h>

#include <functional>
#include <vector>

#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/obstacle/solid.h"

namespace magfsi::fluid {

// Which cells of this rank, and of the layer around it, lie in which obstacle. Computed
// from the geometry alone: ranks need not ask each other.
class SolidMap {
  public:
    static constexpr int fluid = -1;

    // A cell belongs to the first obstacle that holds its centre. Cells beyond a periodic
    // side are those of the opposite end; cells beyond another side count as fluid.
    SolidMap(const FluidConfig& config, const Solids& solids, const CellBox& owned);

    // Local indices from -1 to the number of owned cells: the obstacle, or `fluid`.
    int obstacle(const Cell& local) const { return of_cell_[index(local)]; }
    bool solid(const Cell& local) const { return obstacle(local) != fluid; }

    // Global indices of a cell, wrapped around periodic axes.
    Cell global(const Cell& local) const;
    // Whether the cell lies in the box, after wrapping.
    bool in_box(const Cell& local) const;
    // This rank's cells in each obstacle.
    const std::vector<long long>& cell_counts() const { return cell_counts_; }
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

// A lattice link from a fluid cell into an obstacle.
struct CutLink {
    // By arrangement: slots of the fluid cell for the population that comes from the
    // obstacle and for its opposite.
    std::ptrdiff_t from_wall[2] = {}, to_wall[2] = {};
    // Distance of the wall from the cell over the link's length; exactly 1/2 where the
    // interpolation lacks its second fluid cell.
    double distance = 0.5;
    signed char push[3] = {};  // direction in which the population strikes
    short obstacle = 0;        // whose force it counts in
    short hit = 0;             // that it strikes
    std::array<short, 3> cell{};
};

struct CutLinks {
    std::vector<CutLink> direct;
    // Those that strike an obstacle after their reflection by a side with free slip: the
    // population that a cell sent to the side comes back, half-way. It strikes along its
    // mirror image.
    std::vector<CutLink> reflected;
};

class Obstacles {
  public:
    // owned: this rank's box.
    Obstacles(const FluidConfig& config, const Solids& solids, const CellBox& owned,
              const Populations& populations, const RowLayout& layout);

    const SolidMap& map() const { return map_; }

    // After the exchange and before sides change what cells have sent to them;
    // arrangement: the new one. Notes what free slip reflects into obstacles.
    void note_sent(const Populations& populations, Arrangement arrangement);
    // After the sides, before outlets; arrangement: the new one. What a wall returns is
    // interpolated along the link (Bouzidi et al. 2001): with d its distance from the
    // cell A, B the cell behind, i towards the wall, o away from it and f* what cells
    // sent,
    //     2 d f*_i(A) + (1 - 2 d) f*_i(B)              for d < 1/2,
    //     f*_i(A) / (2 d) + (1 - 1 / (2 d)) f*_o(A)    else,
    // plain half-way bounce-back at 1/2. The impulse on the body is c_i (f*_i + f_o)
    // (Ladd 1994), f*_i what the cell sent to the wall, f_o what that returns, minus
    // weight: gauge pressure. It is exactly what the fluid loses.
    void bounce(const Populations& populations, Arrangement arrangement);
    // Solid cells back to rest. After bounce(), which reads what has arrived there.
    void reset_solid_cells(const Populations& populations, const RowLayout& layout,
                           Arrangement arrangement) const;

    // Impulse of the last step on this rank's links, by obstacle; behind them that of
    // links that do not count.
    const std::vector<Vec3>& impulses() const { return impulses_; }
    std::size_t count() const { return impulses_.size() - 1; }
    // Of a grid with others over or under it: only links from those cells count.
    void count_only(const std::function<bool(const Cell& local)>& counts);

    // The solid cells; local indices.
    const std::vector<CellRow>& rows() const { return rows_; }

  private:
    void find_rows(const RowLayout& layout);
    void add_impulse(const CutLink& link, double populations);

    SolidMap map_;
    CutLinks links_;
    std::vector<double> sent_to_slip_;  // by reflected link
    std::vector<CellRow> rows_;
    std::vector<Vec3> impulses_;
};

// Throws std::invalid_argument on all ranks if an obstacle holds the centre of no cell
// but those of earlier ones. Collective.
void check_resolved(MPI_Comm comm, const FluidConfig& config, const SolidMap& map);
// The same before a run, on one process and of the whole box; on surfaces, too, that
// cannot be.
void check_obstacles(const FluidConfig& config);

}  // namespace magfsi::fluid
