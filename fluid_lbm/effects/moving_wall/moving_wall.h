// Walls that move along themselves: half-way bounce-back gains 6 w rho0 c.u_w on each
// population that leaves the wall (Ladd 1994), rho0 = 1.
#pragma once

#include <array>
#include <vector>

#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

// One side of the box on this rank.
struct MovingWall {
    int axis = 0;
    int side = 0;                      // 0 low, 1 high
    std::array<double, 3> velocity{};  // lattice units, tangential
};

// Adds the wall's term to the slots that hold bounced populations. Called after every
// step: in both arrangements these are the natural slots of the cells at the wall. A link
// through an edge takes the mean velocity of the two walls that meet there (in a
// lid-driven cavity that halves the error against a converged solution); what the box
// gains at one end of a wall it loses at the other.
void move_walls(const Populations& populations, const RowLayout& layout,
                const std::vector<MovingWall>& walls);

}  // namespace magfsi::fluid
