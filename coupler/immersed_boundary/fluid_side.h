// SPDX-License-Identifier: GPL-2.0-or-later
// The fluid rank's half of the immersed boundary.
#pragma once

#include <span>
#include <vector>

#include "coupler/immersed_boundary/balance.h"
#include "coupler/immersed_boundary/no_slip.h"
#include "coupler/immersed_boundary/spreading.h"

namespace magfsi::coupler {

// Spreads the markers' impulses to this rank's cells and samples the velocities at the
// markers. Sums over cells of other ranks are left to those ranks: velocities, row sums
// and q are shares that the structure adds up.
class FluidSide {
  public:
    // owned: the boxes of this rank's cells. fluid must outlive this object.
    FluidSide(GridFluid& fluid, const std::vector<CellBox>& owned, Kernel kernel,
              double coupled_step_s, Forcing forcing = Forcing::penalty);

    // Takes over the boxes that this rank owns after the fluid's grid has moved. Returns
    // true if they differ from before; the markers then have to be placed anew.
    bool own(const std::vector<CellBox>& boxes);

    // Gives the impulses [N s] of a coupled step at the points [m] to the fluid, as a
    // force density over that step.
    void spread(std::span<const Vec3> points_m, std::span<const Vec3> impulse);

    // This rank's share of the fluid's velocities at the points [m/s], before the force
    // of the coming step acts. Valid until the next sample.
    std::span<const Vec3> sample(std::span<const Vec3> points_m);

    // For forcing no_slip. add_passed() comes after spread() and before the fluid
    // advances: it stores this rank's share of q at the points of the spread, from the
    // velocities there, the spread forces and a body force [N/m3] on all of the fluid.
    // add_row_sums() comes after sample(): it stores this rank's share of the row sums at
    // the sampled points, from the markers' volumes.
    void add_passed(double density_kg_m3, const Vec3& body_force, NoSlipAnswer& answer);
    void add_row_sums(std::span<const double> volume_m3, NoSlipAnswer& answer);

    // Must be called when the fluid's velocities have changed: the next spread then reads
    // the cells again instead of reusing the last sample.
    void fluid_has_changed() { read_now_ = false; }

    // Velocities [m/s] of the cells that the last sample read, three per cell, row after
    // row.
    const std::vector<double>& sampled_cells() const { return velocity_; }

    // Sums of what this rank's cells received in the last spread, taken over cells and
    // not over markers, so that they check the spreading. Costs a pass over the touched
    // rows.
    InterfaceBalance received();

    // The same sums if the fluid has advanced since. felt: sampled_cells() of a sample at
    // the points of the last spread, before the fluid advanced.
    InterfaceBalance received(std::span<const double> felt) const;

  private:
    GridFluid& fluid_;
    std::vector<CellBox> owned_;
    Kernel kernel_;
    double coupled_step_s_;
    Forcing forcing_;
    // Cells touched by the last spread and by the last sample.
    TouchedRows spread_rows_;
    TouchedRows sample_rows_;
    // Force density of the last spread [N/m3] and velocities of the last sample [m/s],
    // three numbers per cell.
    std::vector<double> density_;
    std::vector<double> velocity_;
    bool read_now_ = false;  // true while velocity_ is that of the fluid
    std::vector<Vec3> sampled_;
    // For no_slip: the velocities of the cells that the markers of the last spread felt.
    std::vector<double> felt_;
    // For no_slip, one value per cell: the density over that at rest in the cells of
    // velocity_ and of felt_.
    std::vector<double> relative_density_, felt_density_;
    std::vector<Vec3> volume_;  // work array; volumes in the first component
};

}  // namespace magfsi::coupler
