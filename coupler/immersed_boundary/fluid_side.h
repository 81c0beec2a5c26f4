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

    // Adds impulses at the points of the last spread, to act in the same step.
    void spread_more(std::span<const Vec3> impulse);

    // This rank's share of the velocities at the points.
    std::span<const Vec3> sample(std::span<const Vec3> points_m);

    // The same with half the change of velocity that the last spread's forces will make
    // in the coming step, F dt / (2 rho): the physical velocity of Guo's scheme.
    std::span<const Vec3> sample_forced(std::span<const Vec3> points_m,
                                        double density_kg_m3);

    // The velocities of the cells that the last sample looked at, row after row.
    const std::vector<double>& sampled_cells() const { return velocity_; }

    // What this rank's cells received in the last spread: the sums over the cells, not
    // over the markers. Costs a pass over the touched rows.
    InterfaceBalance received();

    // The same where the fluid has moved on since the markers felt it. felt: the
    // sampled_cells() of a sample at the points of the last spread.
    InterfaceBalance received(std::span<const double> felt) const;

  private:
    void read_cells(std::span<const Vec3> points_m);
    std::span<const Vec3> to_markers(std::size_t markers);

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
