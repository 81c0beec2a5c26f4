// Everything at the six sides of this rank's box besides half-way bounce-back, which the
// sweep does itself. Objects exist only for sides that ask for them.
#pragma once

#include <mpi.h>

#include <array>
#include <vector>

#include "fluid_lbm/boundary/free_slip.h"
#include "fluid_lbm/boundary/lattice_side.h"
#include "fluid_lbm/boundary/moving_wall.h"
#include "fluid_lbm/boundary/pressure_outlet.h"
#include "fluid_lbm/boundary/velocity_inlet.h"
#include "fluid_lbm/obstacle/solid_map.h"
#include "fluid_lbm/parallel/decomposition.h"

namespace magfsi::fluid {

class Boundaries {
  public:
    // solids: null without obstacles; cells in them are no part of an outlet. Throws
    // std::invalid_argument on all ranks if one has an outlet but no cell behind it. comm
    // must outlive the object.
    Boundaries(MPI_Comm comm, const Decomposition& decomposition, int rank,
               const std::array<LatticeSide, 6>& sides,
               const std::array<std::array<double, 3>, 6>& wall_velocity,
               const Populations& populations, const RowLayout& layout,
               const SolidMap* solids);

    // Before the sweep.
    void look_at_outlets(const Populations& populations, Arrangement arrangement);
    // After the exchange, in this order: what leaves an edge of two sides is reflected,
    // then gains the terms of walls and inlets, and outlets see the result. Time: steps.
    // Collective.
    void enter(const Populations& populations, const RowLayout& layout, double time);
    void rebuild_outlets(const Populations& populations, Arrangement arrangement) const;

  private:
    std::vector<MovingWall> moving_walls_;
    std::vector<FreeSlip> slips_;
    std::vector<VelocityInlet> inlets_;
    std::vector<PressureOutlet> outlets_;
};

}  // namespace magfsi::fluid
