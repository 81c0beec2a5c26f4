// A cell that went wrong: where it is and why.
#pragma once

#include <optional>

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/solver.h"

namespace magfsi::fluid {

Divergence describe(const Unsound& unsound, const Solver& solver,
                    const FluidConfig& config);

// This rank's first cell, in x, y, z order, whose moments are not finite, whose density
// is not positive or whose speed is above lattice_speed_limit.
std::optional<Divergence> find_divergence(const Solver& solver,
                                          const FluidConfig& config);

}  // namespace magfsi::fluid
