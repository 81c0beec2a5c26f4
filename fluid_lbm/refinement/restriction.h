// SPDX-License-Identifier: GPL-2.0-or-later
// Restriction: covered cells of a level are overwritten by averages of the next finer
// level.
#pragma once

#include "fluid_lbm/refinement/interlevel.h"
#include "fluid_lbm/refinement/transfer.h"

namespace magfsi::fluid {

// The covered cells of the level below within band_cells of cells that are not covered,
// as disjoint boxes.
std::vector<CellBox> band_of(const LevelPlace& fine);

// Overwriting of given boxes of covered cells. Weights and messages are found once; run()
// is called whenever the boxes are to be overwritten.
class Restriction {
  public:
    // boxes: disjoint boxes of the coarser level's covered cells, the same on all ranks.
    Restriction(const Level& coarse, const Level& fine,
                const std::vector<CellBox>& boxes);
    // Overwrites the boxes with the finer level's present state. Collective.
    void run(Level& coarse, const Level& fine);

  private:
    // A coarse cell whose average would read solid fine cells. It takes the mean of those
    // of its own eight fine cells that are not solid. If all are solid it stays as it is;
    // its density is passed on as NaN to mark it.
    struct CutCell {
        std::array<int, 3> cell{};
        // True for those of the eight that are fluid, x fastest.
        std::array<bool, 8> counts{};
    };
    // This rank's share of a box: coarse cells of which it owns the first fine row (of
    // the two along each axis), or, where that row has an even negative index at a cut,
    // the row below.
    struct Piece {
        Piece(const CellBox& share, const Level& fine);

        CellBox coarse;
        CellBox fine;                // fine cells that the averages read
        std::vector<Weights> along;  // weights along x, one per coarse cell
        std::vector<double> flow;    // averages: [z][y][number][x] of the coarse cells
        std::vector<CutCell> cut;

        void find_cut(const Level& level);
        // True if fine cells at a place along an axis lie in coarse cells of the piece.
        // Other cells, which only the cubic reaches, are read without their stress.
        bool has_within(int axis, int place) const;
    };
    // Averages of the cells in Piece::cut, and of all cells of a piece.
    void average_cut(Piece& piece, std::size_t number, const Level& fine);
    void average(Piece& piece, std::size_t number, const Level& fine);
    void average_along_x(const Piece& piece, const double* row, double* to) const;
    // The ten numbers of a fine row: of another rank's row those that have been received,
    // else those read into `room`.
    const double* fine_row(const Piece& piece, std::size_t number, const Level& fine,
                           int y, int z, double* room);

    std::vector<Piece> pieces_;
    // Boxes of fine rows of other ranks, the piece that each belongs to, and their
    // numbers.
    std::vector<CellBox> halo_;
    std::vector<std::size_t> of_piece_;
    std::vector<std::vector<double>> halo_flow_;  // [y, z][number][x]
    CellTransfer to_halo_, to_coarse_;
    std::vector<double> row_, rows_;  // buffers of average()
    // The last four planes across y.
    std::array<std::vector<double>, cubic_points> planes_;
};

}  // namespace magfsi::fluid
