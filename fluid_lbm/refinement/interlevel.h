// What two neighbouring levels tell each other, as density, velocity and stress: cubic
// interpolation from the coarse to the fine one, and back by four points along each axis
// for density and velocity, by the mean of eight cells for the stress. Anything of lower
// order, and a stress that is not rescaled, shows (Lagrava et al. 2012, J. Comput. Phys.
// 231; docs/refinement.md has the figures).
//
// With velocity and density alike on both sides and half the step on half the spacing,
//   tau_f - 1/2 = 2 (tau_c - 1/2),   stress_f = stress_c tau_f / (2 tau_c).
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

// What a restriction learns about mass on the way, of this rank; in cells of the level at
// rest.
struct RestrictedMass {
    double fine = 0;               // excess of the finer level's box
    double before = 0, after = 0;  // of the coarse cells that it covers
};

// Overwrites the covered cells of the coarser level.
class Restriction {
  public:
    Restriction(const Level& coarse, const Level& fine);
    // Collective.
    RestrictedMass run(const Level& coarse, const Level& fine);

  private:
    // Of this rank's share: coarse cells whose first fine row (of each axis' two) is its
    // own.
    void average(const Level& fine, RestrictedMass& mass);
    void average_plane(const Level& fine, int z, std::vector<double>& plane,
                       RestrictedMass& mass);
    void finish_plane(const Level& fine, int z, const std::vector<double>& sum);
    void average_row(const Level& fine, const double* row, double* to) const;
    const double* fine_row(const Level& fine, int y, int z, RestrictedMass& mass);

    CellBox mine_;                                // coarse cells
    CellBox needed_;                              // fine cells that they are made of
    std::vector<CellBox> halo_;                   // of those, others'
    std::vector<std::vector<double>> halo_flow_;  // [y, z][number][x]
    CellTransfer to_halo_, to_coarse_;
    std::vector<double> averaged_;  // [z][y][number][x] of mine_
    std::vector<double> row_;
};

// Of the coarser level's cells around the covered box: adds so much density to each.
// Returns the number of those cells on this rank.
std::int64_t cells_beside(const Level& coarse, const LevelPlace& fine);
void add_density_beside(const Level& coarse, const LevelPlace& fine, double excess);

}  // namespace magfsi::fluid
