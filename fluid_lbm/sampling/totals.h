// Integrals over the fluid in the box, without obstacles.
#pragma once

#include <mpi.h>

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/solver.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

// Collective.
Totals totals(MPI_Comm comm, const Solver& solver, const Units& unit);

// Mean of |curl u|^2 / 2, lattice units. Collective.
double mean_enstrophy(MPI_Comm comm, const Solver& solver,
                      const std::array<Vec3, 6>& lattice_wall_velocity);

}  // namespace magfsi::fluid
