// SPDX-License-Identifier: GPL-2.0-or-later
// One time step of rows of a rank, apart from halo exchange, boundaries and obstacles.
#pragma once

#include <optional>

#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/sampling/moments.h"
#include "fluid_lbm/streaming/forced_rows.h"

namespace magfsi::fluid {

// A cell that failed the check of its kernel. Lattice units; indices within the rank.
// Density and velocity are those that the collision saw.
struct InvalidCell {
    int z = 0, y = 0, x = 0;
    double density = 0, speed = 0, force = 0;

    bool before(const InvalidCell& other) const {
        return z != other.z ? z < other.z : y < other.y;
    }
};

// Steps the rows of a box. now: before the step; the sweep of all rows turns the
// arrangement. forces: null where nothing can push the fluid. Every slot is touched by
// one row only: OpenMP's threads share the rows, and any number of them gives the same
// bits. Returns the first invalid cell by z, then y. x_ends: false where nobody needs
// what arrives at the ends of rows from beyond them.
//
// Threads that spin while they wait for each other take cores from other processes: where
// those are shared, run with OMP_WAIT_POLICY=passive.
std::optional<InvalidCell> sweep(const View& now, const ForcedRows* forces,
                                 const CollisionParameters& parameters, const RowBox& box,
                                 bool x_ends = true);

}  // namespace magfsi::fluid
