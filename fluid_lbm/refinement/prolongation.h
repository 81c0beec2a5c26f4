// SPDX-License-Identifier: GPL-2.0-or-later
// Prolongation: cells of a level are filled by cubic interpolation from the next coarser
// level.
#pragma once

#include "fluid_lbm/refinement/interlevel.h"
#include "fluid_lbm/refinement/transfer.h"

namespace magfsi::fluid {

// Weights of the fine cells of a line among the coarse ones. From cell `begin` to cell
// `end` all pairs of fine cells have the same weights, shifted by one coarse cell per
// pair.
struct Expansion {
    std::vector<Weights> of;
    int lo = 0;  // first coarse cell of the line
    std::size_t begin = 0, end = 0;
};

// Interpolation of given boxes of the finer level from the coarser one. Boxes, weights
// and messages are found once; run() is called whenever the boxes are to be filled.
class Prolongation {
  public:
    // place: of the finer level; of_ranks: for each rank, boxes of cells that it stores
    // there.
    Prolongation(const Level& coarse, const LevelPlace& place,
                 const std::vector<std::vector<CellBox>>& of_ranks);
    // Fills the boxes from the coarser level's present state. Collective.
    void run(const Level& coarse, Level& fine);

  private:
    // A coarse cell in an obstacle. The cubic is given numbers there that follow from the
    // cells beside it which lie in the fluid or have been given numbers before. first,
    // beside: place of the first number of the cell, and of each of those, in
    // Piece::flow.
    struct SolidCell {
        std::size_t first = 0;
        std::vector<std::size_t> beside;
        bool at_wall = true;  // true if it lies beside fluid cells
    };
    // A box of fine cells and the coarse cells beneath it, whose numbers are stored as
    // [z][other][number][line]. Lines run along x, or along y in boxes that are as thin
    // along x as a ring.
    struct Piece {
        CellBox fine, coarse;
        int line = 0, other = 1;          // axes
        Expansion expansion;              // along the lines
        std::vector<Weights> across, up;  // weights along `other` and along z
        std::vector<double> flow;         // numbers of the coarse cells
        std::vector<SolidCell> solids;

        Piece(const CellBox& fine_cells, const Level& level, const LevelPlace& place);
        std::size_t length(const CellBox& box, int axis) const {
            return box.hi[axis] - box.lo[axis];
        }
        // Addresses of the ten numbers of a row along x, in a piece with lines along x.
        std::array<double*, numbers_between_levels> of_row(const CellRow& row);
        // Stores the numbers of a row of coarse cells along x.
        void take(const CellRow& row, const double* numbers);
        // Place in `flow` of the first number of a coarse cell.
        std::size_t first_number(const std::array<int, 3>& cell) const;
        // Finds the solid cells that a cubic may read.
        void find_solids(const Level& level);
        // Gives these cells their numbers.
        void extend_into_solids();
    };
    void interpolate(const Piece& piece, const Scales& scales, const Level& fine);

    std::vector<Piece> pieces_;
    CellTransfer transfer_;
    std::vector<double> plane_, line_, row_;  // buffers of interpolate()
};

// The cells of the finer level's ring, as boxes of each rank.
std::vector<std::vector<CellBox>> ring_of(const Level& fine);

}  // namespace magfsi::fluid
