// SPDX-License-Identifier: GPL-2.0-or-later
// The coarse cells beside a patch, which receive the mass that the interface has lost.
#pragma once

#include <cstdint>

#include "fluid_lbm/refinement/level.h"

namespace magfsi::fluid {

// Number of this rank's fluid cells of the coarser level that surround the covered box.
std::int64_t cells_beside(const Level& coarse, const LevelPlace& fine);
// Adds `excess` (in units of the density at rest) to the density of each of these cells.
void add_density_beside(const Level& coarse, const LevelPlace& fine, double excess);

}  // namespace magfsi::fluid
