// SPDX-License-Identifier: GPL-2.0-or-later
// From a level to the next coarser one: cells that it covers are overwritten.
#pragma once

#include "fluid_lbm/refinement/interlevel.h"
#include "fluid_lbm/refinement/transfer.h"

namespace magfsi::fluid {

// The covered cells of the level below that are so close to those that are not.
std::vector<CellBox> band_of(const LevelPlace& fine);

// Overwrites boxes of covered cells of the coarser level.
class Restriction {
  public:
    // boxes: disjoint.
    Restriction(const Level& coarse, const Level& fine,
                const std::vector<CellBox>& boxes);
    // Collective.
    void run(Level& coarse, const Level& fine);

  private:
    // A coarse cell with solid ones among the fine cells that its average reads: instead
    // the mean of those of its eight that are not. Without any it stays as it is: its
    // density is then not a number on the way.
    struct CutCell {
        std::array<int, 3> cell{};
        std::array<bool, 8> counts{};  // x fastest
    };
    // This rank's share of a box: coarse cells whose first fine row (of each axis' two)
    // is its own.
    struct Piece {
        Piece(const CellBox& share, const Level& fine);

        CellBox coarse;
        CellBox fine;                // that they are made of
        std::vector<Weights> along;  // x, of the coarse cells
        std::vector<double> flow;    // [z][y][number][x] of the coarse cells
        std::vector<CutCell> cut;

        void find_cut(const Level& level);
        // Whether fine cells at that place of an axis are in coarse ones: others, which
        // the averages reach to, are read without their stress.
        bool has_within(int axis, int place) const;
    };
    void average_cut(Piece& piece, std::size_t number, const Level& fine);
    void average(Piece& piece, std::size_t number, const Level& fine);
    void average_along_x(const Piece& piece, const double* row, double* to) const;
    // The ten numbers of a fine row, of another rank's where they have come, else read
    // into `room`.
    const double* fine_row(const Piece& piece, std::size_t number, const Level& fine,
                           int y, int z, double* room);

    std::vector<Piece> pieces_;
    // Fine rows of other ranks; whose piece's they are.
    std::vector<CellBox> halo_;
    std::vector<std::size_t> of_piece_;
    std::vector<std::vector<double>> halo_flow_;  // [y, z][number][x]
    CellTransfer to_halo_, to_coarse_;
    std::vector<double> row_, rows_;  // under way
    std::array<std::vector<double>, cubic_points> planes_;
};

}  // namespace magfsi::fluid
