// Integrals over the box and the search for a cell that went wrong.
#pragma once

#include <mpi.h>

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/solver.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

// Collective.
Totals totals(MPI_Comm comm, const Solver& solver, const Units& unit,
              const std::array<Vec3, 6>& lattice_wall_velocity);

// This rank's first cell, in x, y, z order, whose moments are not finite, whose density
// is not positive or whose speed is above lattice_speed_limit.
std::optional<Divergence> find_divergence(const Solver& solver);

}  // namespace magfsi::fluid
