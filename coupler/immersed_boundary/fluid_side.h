// SPDX-License-Identifier: GPL-2.0-or-later
// The immersed boundary as a fluid rank sees it: forces of a step, velocities at markers.
#pragma once

#include <span>
#include <vector>

#include "coupler/immersed_boundary/balance.h"
#include "coupler/immersed_boundary/no_slip.h"
#include "coupler/immersed_boundary/spreading.h"

namespace magfsi::coupler {

// The fluid rank's half of the immersed boundary: spreads impulses, samples velocities.
class FluidSide {
  public:
    FluidSide(GridFluid& fluid, const std::vector<CellBox>& owned, Kernel kernel,
              double coupled_step_s, Forcing forcing = Forcing::penalty);

    // The cells of this rank, where the fluid's grid may have moved. True if it has: then
    // nothing is placed.
    bool own(const std::vector<CellBox>& boxes);

    // Gives the impulses [N s] of a step to the fluid as forces over that step. more:
    // besides those of the last spread, at the same points.
    void spread(std::span<const Vec3> points_m, std::span<const Vec3> impulse,
                bool more = false);

    // This rank's share of the velocities at the points.
    std::span<const Vec3> sample(std::span<const Vec3> points_m);

    // The same with half the change of velocity that the last spread's forces will make
    // in the coming step, F dt / (2 rho): the physical velocity of Guo's scheme.
    std::span<const Vec3> sample_forced(std::span<const Vec3> points_m,
                                        double density_kg_m3);

    // For forcing no_slip, after spread() and before sample(): q at the points of the
    // spread, with the velocities sampled there and a force [N/m3] on all of the fluid;
    // after it: the row sums at its points, with the markers' volumes. This rank's
    // shares.
    void add_passed(double density_kg_m3, const Vec3& body_force, NoSlipAnswer& answer);
    void add_row_sums(std::span<const double> volume_m3, NoSlipAnswer& answer);

    // After the fluid's velocities have changed: the next spread reads anew what the last
    // sample has read.
    void fluid_has_changed() { read_now_ = false; }

    // The velocities of the cells that the last sample read, row after row.
    const std::vector<double>& sampled_cells() const { return velocity_; }

    // What this rank's cells received in the last spread: the sums over the cells, not
    // over the markers. Costs a pass over the touched rows.
    InterfaceBalance received();

    // The same where the fluid has moved on since the markers felt it. felt: the
    // sampled_cells() of a sample at the points of the last spread.
    InterfaceBalance received(std::span<const double> felt) const;

  private:
    void read_cells(std::span<const Vec3> points_m);
    std::span<const Vec3> interpolate(std::size_t markers);

    GridFluid& fluid_;
    std::vector<CellBox> owned_;
    Kernel kernel_;
    double coupled_step_s_;
    Forcing forcing_;
    TouchedRows spread_rows_;
    TouchedRows sample_rows_;
    std::vector<double> density_;
    std::vector<double> velocity_;
    bool read_now_ = false;  // velocity_ is that of the fluid as it is
    std::vector<Vec3> sampled_;
    // Of no_slip: the cells' velocities that the markers of the last spread felt.
    std::vector<double> felt_;
    // Also of no_slip, one value a cell: the density over that at rest of the cells in
    // velocity_ and in felt_.
    std::vector<double> relative_density_, felt_density_;
    std::vector<Vec3> volume_;  // in the first component
};

}  // namespace magfsi::coupler
