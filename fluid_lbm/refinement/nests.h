// SPDX-License-Identifier: GPL-2.0-or-later
// Which patches there are. A nest is a patch of each finer level, one in the other,
// around a body. Bodies whose nests would come near each other share one, around all of
// them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fluid_lbm/refinement/patch.h"

namespace magfsi::fluid {

// How nests lie around bodies, in cells of the finest level but one.
struct PatchRule {
    int levels = 1;        // finer ones
    int margin_cells = 0;  // between bodies and the sides of the finest patch, at least
    int slack_cells = 1;   // besides, before it follows
    bool follows = true;   // else it stays, and bodies have to
};

using BodyBox = std::array<Vec3, 2>;         // lower and upper corner [m]
using NestPlaces = std::vector<LevelPlace>;  // of each finer level, the coarsest first

// Cells of level 0 between two nests, at least: what each interpolates from, and cells
// whose step neither has to do with.
constexpr int between_nests_cells = 2 * apart_cells;

// For bodies in those boxes, of which there is at least one. before: the nests that there
// are, null at first. One whose bodies keep their margin stays as it is; absent result:
// all do.
std::optional<std::vector<NestPlaces>> place_nests(const FluidConfig& coarse,
                                                   const PatchRule& rule,
                                                   const std::vector<BodyBox>& bodies_m,
                                                   const std::vector<NestPlaces>* before);

}  // namespace magfsi::fluid
