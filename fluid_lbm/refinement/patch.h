// SPDX-License-Identifier: GPL-2.0-or-later
// Place of the finer levels. Level 0 is the uniform grid over the whole box; level l has
// a spacing and a time step 2^l times smaller and covers a box of cells of level l - 1.
// Beyond that box, on sides that are not sides of the domain, a level has a ring of two
// cells, which is filled anew in every second of its steps: the error from the wall
// behind the ring travels inwards by one cell per step.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fluid_lbm/config.h"
#include "fluid_lbm/obstacle/solid.h"

namespace magfsi::fluid {

constexpr int ring_cells = 2;  // width of the ring
// Least distance, in cells of a level, from the box of the next finer level to the
// level's own ring: two cells under the finer ring and two for a cubic. Closer, the finer
// level would read cells that are not filled.
constexpr int apart_cells = 4;
// Width of the band of covered cells, beside those that are not covered, that a level
// reads before they are overwritten again: in its step, and in the cubic that fills the
// ring.
constexpr int band_cells = 1;
// Least number of cells that a patch covers along an axis: a cubic through its own cells.
constexpr int least_cells = 2;
// Least number of cells of a level around the box of the next finer one, for stencils.
constexpr int around_cells = apart_cells;

// Place of a level, in global indices of its own cells, from the corner of the whole box
// on.
struct LevelPlace {
    std::array<int, 3> domain{};  // number of its cells that would fill the whole box
    CellBox inside;               // cells that it solves: the covered box
    CellBox stored;               // cells with the ring
    // Number of cells along axes that it covers from one periodic side to the other, else
    // 0.
    std::array<int, 3> period{};

    // The covered box in cells of the level below.
    CellBox covered() const;
    bool operator==(const LevelPlace&) const = default;
};

// Place of level 0. cells, periodic: of the whole box.
LevelPlace coarsest_place(const std::array<int, 3>& cells,
                          const std::array<bool, 3>& periodic);
// Place over a box of the level below, clipped to the domain. A side that is closer to a
// wall than a ring and its stencils moves to the wall; a box that comes as close to
// itself across periodic sides covers the whole axis. Where the box crosses a periodic
// side, its indices go on beyond the side.
LevelPlace finer_place(const LevelPlace& below, const std::array<bool, 3>& periodic,
                       CellBox covered);

// Configuration of the fluid that solves a level: level 0 as it is, finer levels as a box
// of their stored cells. Throws std::invalid_argument if an inlet or an outlet would be a
// side of the patch.
FluidConfig config_at(const FluidConfig& coarse, const LevelPlace& place, int level);

// Throws std::invalid_argument if the sides of a patch cut an obstacle; for patches that
// follow bodies in runs that read forces on obstacles. The links of two levels form no
// closed surface, and an interpolated flow adapts to walls within a step: the drag of a
// ball was off by 17 % with a side at its stagnation point, and by a third in the step
// after a move (tests/validation/fluid_lbm/refinement.cpp has the ball). config, solids:
// of the level.
void refuse_cut_obstacles(const FluidConfig& config, const Solids& solids,
                          const LevelPlace& place);

}  // namespace magfsi::fluid
