// SPDX-License-Identifier: GPL-2.0-or-later
// The coarse cells around a patch, through which its mass comes and goes.
#pragma once

#include <cstdint>

#include "fluid_lbm/refinement/level.h"

namespace magfsi::fluid {

// Of the coarser level's cells around the covered box: adds so much density to each.
// Returns the number of those cells on this rank.
std::int64_t cells_beside(const Level& coarse, const LevelPlace& fine);
void add_density_beside(const Level& coarse, const LevelPlace& fine, double excess);

}  // namespace magfsi::fluid
