// Finding the cell in a row whose kernel reported that one is no longer sound.
#pragma once

#include "fluid_lbm/forcing/forced_rows.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/streaming/kernels.h"

namespace magfsi::fluid {

// Lattice units; indices within the rank. Velocity and density are those that the
// collision saw.
struct UnsoundCell {
    int z = 0, y = 0, x = 0;
    double density = 0, speed = 0, force = 0;

    bool before(const UnsoundCell& other) const {
        return z != other.z ? z < other.z : y < other.y;
    }
};

// Real: float or double. The first cell of row (y, z) that fails the watch (or the
// fastest, should rounding hide it), from the populations that its collision left: it
// has kept the density and added the force to the momentum.
template <class Real>
UnsoundCell find_unsound(const RowPointers<Real>& p, const ForcePointers<Real>& force,
                         int length, MomentsKernel<Real> moments, int y, int z);

}  // namespace magfsi::fluid
