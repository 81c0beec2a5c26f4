// From a level to the next finer one: cells are filled by cubic interpolation.
#pragma once

#include "fluid_lbm/refinement/level.h"
#include "fluid_lbm/refinement/transfer.h"

namespace magfsi::fluid {

// Fills cells of the finer level from the coarser one.
class Prolongation {
  public:
    // of_ranks: boxes of stored cells of the finer level, of each rank its own.
    Prolongation(const Level& coarse, const std::vector<std::vector<CellBox>>& of_ranks);
    // Collective.
    void run(const Level& coarse, const Level& fine);

  private:
    // A box of fine cells and the coarse ones beneath, whose numbers are laid out as
    // [z][other][number][line]: lines are along x, in boxes as thin there as a ring
    // along y.
    struct Piece {
        CellBox fine, coarse;
        int line = 0, other = 1;
        std::vector<double> flow;

        std::size_t length(const CellBox& box, int axis) const {
            return static_cast<std::size_t>(box.hi[axis] - box.lo[axis]);
        }
        void take(const CellRow& row, const double* numbers);
    };
    void interpolate(const Piece& piece, const Level& coarse, const Level& fine);

    std::vector<Piece> pieces_;
    CellTransfer transfer_;
    std::vector<double> plane_, line_, row_;  // under way
};

// The ring of the finer level, of every rank.
std::vector<std::vector<CellBox>> ring_of(const Level& fine);

}  // namespace magfsi::fluid
