// The fluid rank's half of the immersed boundary: spreads impulses, samples velocities.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "coupler/immersed_boundary/balance.h"
#include "coupler/immersed_boundary/grid_fluid.h"
#include "coupler/immersed_boundary/touched_rows.h"

namespace magfsi::coupler {

class FluidSide {
  public:
    FluidSide(GridFluid& fluid, const CellBox& owned, Kernel kernel,
              double coupled_step_s);

    // Gives the impulses [N s] of a step to the fluid as forces over that step.
    void spread(std::span<const Vec3> points_m, std::span<const Vec3> impulse);

    // This rank's share of the velocities at the points.
    std::span<const Vec3> sample(std::span<const Vec3> points_m);

    // What this rank's cells received in the last spread: the sums over the cells, not
    // over the markers. Costs a pass over the touched rows.
    InterfaceBalance received();

  private:
    GridFluid& fluid_;
    double coupled_step_s_;
    TouchedRows spread_rows_;
    TouchedRows sample_rows_;
    std::vector<double> density_;
    std::vector<double> velocity_;
    std::vector<Vec3> force_;
    std::vector<Vec3> sampled_;
};

}  // namespace magfsi::coupler
