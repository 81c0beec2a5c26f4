// From the SI description of obstacles to the solver's.
#pragma once

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/obstacle/solid_map.h"

namespace magfsi::fluid {

// In the order of the configuration. Throws std::invalid_argument with a sentence on the
// first obstacle that cannot be.
Solids make_solids(const FluidConfig& config);

// Throws std::invalid_argument on all ranks if an obstacle holds the centre of no cell.
// Collective.
void check_resolved(MPI_Comm comm, const FluidConfig& config, const SolidMap& map);

}  // namespace magfsi::fluid
