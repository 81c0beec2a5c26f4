// One time step of all rows of a rank, apart from halo exchange and moving walls.
#pragma once

#include <optional>

#include "fluid_lbm/forcing/forced_rows.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/lattice/row_layout.h"
#include "fluid_lbm/parallel/row_boxes.h"
#include "fluid_lbm/streaming/kernel_choice.h"
#include "fluid_lbm/streaming/unsound.h"

namespace magfsi::fluid {

// What the rows of one step share.
struct SweepInput {
    const Populations& populations;
    const RowLayout& layout;
    Arrangement arrangement;   // before the step; the sweep of all rows turns it
    const ForcedRows* forces;  // null where nothing can push the fluid
    const AnyKernels& kernels;
    const CollisionParameters& parameters;
};

// Steps the rows of a box. Every slot is touched by one row only: OpenMP's threads share
// the rows, and any number of them gives the same bits. Returns the first unsound cell
// by z, then y.
//
// Threads that spin while they wait for each other take cores from other processes: where
// those are shared, run with OMP_WAIT_POLICY=passive.
std::optional<UnsoundCell> sweep(const SweepInput& in, const RowBox& box);

}  // namespace magfsi::fluid
