// From the SI description of obstacles to the solver's.
#pragma once

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/obstacle/solid.h"

namespace magfsi::fluid {

// In the order of the configuration. Throws std::invalid_argument with a sentence on the
// first obstacle that cannot be.
Solids make_solids(const FluidConfig& config);

}  // namespace magfsi::fluid
