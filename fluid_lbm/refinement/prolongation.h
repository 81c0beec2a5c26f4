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
    struct Piece {
        CellBox fine, coarse;
        std::vector<double> flow;  // [z][y][number][x] of the coarse cells
    };
    static void interpolate(const Piece& piece, const Level& coarse, const Level& fine);

    std::vector<Piece> pieces_;
    CellTransfer transfer_;
};

// The ring of the finer level, of every rank.
std::vector<std::vector<CellBox>> ring_of(const Level& fine);

}  // namespace magfsi::fluid
