// From a level to the next coarser one: what it covers is overwritten.
#pragma once

#include "fluid_lbm/refinement/level.h"
#include "fluid_lbm/refinement/transfer.h"

namespace magfsi::fluid {

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
