// One time step of all rows of a rank, apart from halo exchange and moving walls.
#pragma once

#include "fluid_lbm/forcing/forced_rows.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/lattice/row_layout.h"
#include "fluid_lbm/streaming/kernels.h"

namespace magfsi::fluid {

// Turns the given arrangement into the other one. Every slot is touched by one row only:
// the loop may be split among threads anywhere.
void sweep(const Populations& populations, const RowLayout& layout,
           Arrangement arrangement, const ForcedRows& forces, const RowKernels& kernels,
           double omega);

}  // namespace magfsi::fluid
