// One time step of all rows of a rank, apart from halo exchange and moving walls.
#pragma once

#include "fluid_lbm/forcing/forced_rows.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/lattice/row_layout.h"
#include "fluid_lbm/streaming/kernel_choice.h"

namespace magfsi::fluid {

// Turns the given arrangement into the other one. Every slot is touched by one row only:
// threads share the rows, and any number of them gives the same bits.
void sweep(const Populations& populations, const RowLayout& layout,
           Arrangement arrangement, const ForcedRows& forces, const AnyKernels& kernels,
           const CollisionParameters& parameters);

}  // namespace magfsi::fluid
