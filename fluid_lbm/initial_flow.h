// The state that a run starts from.
#pragma once

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/solver.h"

namespace magfsi::fluid {

// Populations of the configured velocity and pressure, with the viscous stress of the
// velocity's gradient (central differences over one cell, so that the functions are asked
// only for points inside the box or on its sides). Leaves rest alone if both are absent.
void set_initial_flow(const FluidConfig& config, const Solver& solver);

}  // namespace magfsi::fluid
