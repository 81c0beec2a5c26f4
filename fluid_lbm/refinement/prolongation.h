// SPDX-License-Identifier: GPL-2.0-or-later
// From a level to the next finer one: cells are filled by cubic interpolation.
#pragma once

#include "fluid_lbm/refinement/interlevel.h"
#include "fluid_lbm/refinement/transfer.h"

namespace magfsi::fluid {

// Weights of the fine cells of a line.
struct Expansion {
    std::vector<Weights> of;
    int lo = 0;                      // the first coarse cell that is there
    std::size_t begin = 0, end = 0;  // between them pairs of cells are alike
};

// Fills cells of the finer level from the coarser one.
class Prolongation {
  public:
    // of_ranks: boxes of stored cells of the finer level at that place, of each rank its
    // own.
    Prolongation(const Level& coarse, const LevelPlace& place,
                 const std::vector<std::vector<CellBox>>& of_ranks);
    // Collective.
    void run(const Level& coarse, Level& fine);

  private:
    // A coarse cell in an obstacle: what the cubic finds there follows from the cells
    // beside it that the fluid has, or that have been found before. Of each the first
    // number in a piece, as of the cell.
    struct SolidCell {
        std::size_t first = 0;
        std::vector<std::size_t> beside;
        bool at_wall = true;  // beside cells of the fluid
    };
    // A box of fine cells and the coarse ones beneath, whose numbers are laid out as
    // [z][other][number][line]: lines are along x, in boxes as thin there as a ring
    // along y.
    struct Piece {
        CellBox fine, coarse;
        int line = 0, other = 1;
        Expansion expansion;              // along the lines
        std::vector<Weights> across, up;  // of the fine cells along the other axes
        std::vector<double> flow;
        std::vector<SolidCell> solids;

        Piece(const CellBox& fine_cells, const Level& level, const LevelPlace& place);
        std::size_t length(const CellBox& box, int axis) const {
            return static_cast<std::size_t>(box.hi[axis] - box.lo[axis]);
        }
        // Where the numbers of a row along x begin, in a piece whose lines those are.
        std::array<double*, numbers_between_levels> of_row(const CellRow& row);
        void take(const CellRow& row, const double* numbers);
        std::size_t first_number(const std::array<int, 3>& cell) const;
        void find_solids(const Level& level);
        void extend_into_solids();
    };
    void interpolate(const Piece& piece, double stress_scale, const Level& fine);

    std::vector<Piece> pieces_;
    CellTransfer transfer_;
    std::vector<double> plane_, line_, row_;  // under way
};

// The ring of the finer level, of every rank.
std::vector<std::vector<CellBox>> ring_of(const Level& fine);

}  // namespace magfsi::fluid
