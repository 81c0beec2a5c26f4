// SPDX-License-Identifier: GPL-2.0-or-later
// Where the finer levels lie. Level 0 is the uniform grid over the whole box; level l has
// a spacing and a time step 2^l times smaller and covers a box of cells of level l - 1.
// Beyond the box, on sides that are not those of the domain, a level has a ring of two
// cells that are filled anew in every second of its steps: what the wall behind the ring
// makes wrong walks inwards by a cell a step.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fluid_lbm/config.h"
#include "fluid_lbm/obstacle/solid.h"

namespace magfsi::fluid {

constexpr int ring_cells = 2;
// Cells of a level between the box of the next finer one and its own ring, or it reads
// what has not been filled: two under the ring, two for a cubic.
constexpr int apart_cells = 4;
// Covered cells, beside those that are not, that a level reads before they are
// overwritten anew: in its step, and in the cubic that fills the ring.
constexpr int band_cells = 1;
// Cells that a patch covers along an axis, at least: a cubic through its own cells.
constexpr int least_cells = 2;
// Cells of a level around what the next finer one covers: what stencils need.
constexpr int around_cells = apart_cells;

// A level's place: all in global indices of its own cells, from the corner of the whole
// box on.
struct LevelPlace {
    std::array<int, 3> domain{};  // cells that it would have over the whole box
    CellBox inside;               // what it solves: the covered box
    CellBox stored;               // with the ring
    // Cells along axes that it covers from one periodic side to the other, else 0.
    std::array<int, 3> period{};

    // Of the level below.
    CellBox covered() const;
    bool operator==(const LevelPlace&) const = default;
};

// cells, periodic: of the whole box.
LevelPlace coarsest_place(const std::array<int, 3>& cells,
                          const std::array<bool, 3>& periodic);
// Over a box of the level below, clipped to the domain: sides closer to walls than a ring
// and its stencils become those, and a box that comes as close to itself across periodic
// sides covers the whole axis. Where it crosses a periodic side its indices go on beyond.
LevelPlace finer_place(const LevelPlace& below, const std::array<bool, 3>& periodic,
                       CellBox covered);

// What solves a level: level 0 as it is, others as a box of their stored cells. Throws
// std::invalid_argument where an inlet or an outlet would be a side of the patch.
FluidConfig config_at(const FluidConfig& coarse, const LevelPlace& place, int level);

// For a patch that follows, where forces on obstacles are read: throws
// std::invalid_argument if its sides cut one. The links of two levels are those of no
// closed surface, and an interpolated flow settles at walls in a step: the drag of a ball
// was off by 17 % with a side at its stagnation point, by a third in the step after a
// move (validation/fluid_lbm/refinement.cpp has the ball). config, solids: of the level.
void refuse_cut_obstacles(const FluidConfig& config, const Solids& solids,
                          const LevelPlace& place);

}  // namespace magfsi::fluid
