// SPDX-License-Identifier: GPL-2.0-or-later
// Collision and streaming of a rank's rows in one time step, without halo exchange,
// boundaries and obstacles.
#pragma once

#include <optional>

#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/sampling/moments.h"
#include "fluid_lbm/streaming/forced_rows.h"

namespace magfsi::fluid {

// A cell that failed the check of its kernel: local indices, and density, speed and force
// as the collision saw them. Lattice units.
struct InvalidCell {
    int z = 0, y = 0, x = 0;
    double density = 0, speed = 0, force = 0;

    // Order of reports: by z, then y.
    bool before(const InvalidCell& other) const {
        return z != other.z ? z < other.z : y < other.y;
    }
};

// Collides and streams the rows of a box. now: the state before the step; the arrangement
// has changed once all rows have been swept. forces: null if no row has a force. x_ends:
// false if the values that arrive at the ends of rows from beyond them are not needed.
// Returns the first invalid cell by z, then y.
//
// Every slot is touched by one row only: the threads of OpenMP share the rows, and any
// number of threads gives the same bits. Threads that spin while they wait for each other
// take cores from other processes: where cores are shared, run with
// OMP_WAIT_POLICY=passive.
std::optional<InvalidCell> sweep(const View& now, const ForcedRows* forces,
                                 const RowBox& box, bool x_ends = true);

}  // namespace magfsi::fluid
