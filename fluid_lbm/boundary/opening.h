// From the SI description of a side to its lattice units: which cells are open, and the
// velocity profile over them.
#pragma once

#include "fluid_lbm/boundary/lattice_side.h"

namespace magfsi::fluid {

// Of an accepted configuration (check_boundaries()).
LatticeSide lattice_side(const FluidConfig& config, int side);

// Whether the centre of a cell's face on the side lies in the patch; true without one.
bool is_open(const FluidConfig& config, int side, const Cell& cell);

// Throws std::invalid_argument with a sentence on the first side that cannot run.
void check_boundaries(const FluidConfig& config);

}  // namespace magfsi::fluid
