// SPDX-License-Identifier: GPL-2.0-or-later
// Placement of the patches. A nest is a patch of each finer level, one inside the other,
// around a body. Bodies whose nests would come near each other share one nest.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fluid_lbm/refinement/patch.h"

namespace magfsi::fluid {

// Rule by which nests surround bodies; lengths in cells of the finest level but one.
struct PatchRule {
    int levels = 1;        // number of finer levels
    int margin_cells = 0;  // least distance from a body to a side of the finest patch
    int slack_cells = 1;   // further distance in a new patch
    bool follows = true;   // false: the patch stays, and bodies must keep inside
};

using BodyBox = std::array<Vec3, 2>;  // lower and upper corner [m]
// One place per finer level, the coarsest first.
using NestPlaces = std::vector<LevelPlace>;

// Least distance of two nests in cells of level 0: room for the stencils of both, and for
// cells whose step depends on neither.
constexpr int between_nests_cells = 2 * apart_cells;

// The nests around bodies in these boxes (at least one). before: the present nests, null
// if there are none. A nest whose bodies keep their margin stays as it is. Absent if all
// stay.
std::optional<std::vector<NestPlaces>> place_nests(const FluidConfig& coarse,
                                                   const PatchRule& rule,
                                                   const std::vector<BodyBox>& bodies_m,
                                                   const std::vector<NestPlaces>* before);

// Throws std::invalid_argument if a body does not keep the least margin to the sides of
// nests that stay where they are.
void refuse_bodies_at_sides(const FluidConfig& coarse, PatchRule rule,
                            int least_margin_cells, const std::vector<BodyBox>& bodies_m,
                            const std::vector<NestPlaces>& places);

}  // namespace magfsi::fluid
