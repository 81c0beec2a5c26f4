// Integrals over a plane across the box.
#pragma once

#include <mpi.h>

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/solver.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

// Linear between the two layers of cells whose centres lie on either side of the plane;
// within half a cell of an end of the box, the last layer. Collective.
PlaneFlow plane_flow(MPI_Comm comm, const Solver& solver, const Units& unit, int axis,
                     double at_cells);

}  // namespace magfsi::fluid
