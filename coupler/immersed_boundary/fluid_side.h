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
// and q are shares that the structure adds up. This is all that forcing penalty needs.
class FluidSide {
  public:
    // owned: the boxes of this rank's cells. fluid must outlive this object.
    FluidSide(GridFluid& fluid, const std::vector<CellBox>& owned, Kernel kernel,
              double coupled_step_s);
    virtual ~FluidSide() = default;

    // Takes over the boxes that this rank owns after the fluid's grid has moved. Returns
    // true if they differ from before; the markers then have to be placed anew.
    bool own(const std::vector<CellBox>& boxes);

    // Gives the impulses [N s] of a coupled step at the points [m] to the fluid, as a
    // force density over that step.
    virtual void spread(std::span<const Vec3> points_m, std::span<const Vec3> impulse);

    // This rank's share of the fluid's velocities at the points [m/s], before the force
    // of the coming step acts. Valid until the next sample. volume_m3: fluid that each
    // marker moves, used in forcing no_slip only.
    virtual std::span<const Vec3> sample(std::span<const Vec3> points_m,
                                         std::span<const double> volume_m3 = {});

    // This rank's share of the answer that goes with the velocities; null unless the
    // forcing has one.
    virtual const NoSlipAnswer* answer() const { return nullptr; }

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

  protected:
    GridFluid& fluid_;
    double coupled_step_s_;
    // Cells touched by the last spread and by the last sample.
    TouchedRows spread_rows_;
    TouchedRows sample_rows_;
    // Force density of the last spread [N/m3] and velocities of the last sample [m/s],
    // three numbers per cell.
    std::vector<double> density_;
    std::vector<double> velocity_;

  private:
    // Called before forces are set in the cells of spread_rows_. known: the last sample
    // read these cells, and the fluid has not changed since.
    virtual void note_felt(bool /*known*/) {}
    // Place for the densities of the cells of sample_rows_ (GridFluid::velocity).
    virtual std::span<double> room_for_density() { return {}; }

    std::vector<CellBox> owned_;
    Kernel kernel_;
    bool read_now_ = false;  // true while velocity_ is that of the fluid
    std::vector<Vec3> sampled_;
};

// The same in forcing no_slip, with this rank's shares of the answer: spread() adds q at
// its points, from the velocities there, the spread forces and a body force on all of the
// fluid; sample() adds the row sums at the sampled points.
class NoSlipFluidSide final : public FluidSide {
  public:
    // density_kg_m3: that of the fluid at rest; body_force: [N/m3].
    NoSlipFluidSide(GridFluid& fluid, const std::vector<CellBox>& owned, Kernel kernel,
                    double coupled_step_s, double density_kg_m3, const Vec3& body_force);

    void spread(std::span<const Vec3> points_m, std::span<const Vec3> impulse) override;
    std::span<const Vec3> sample(std::span<const Vec3> points_m,
                                 std::span<const double> volume_m3) override;
    const NoSlipAnswer* answer() const override { return &answer_; }

  private:
    void note_felt(bool known) override;
    std::span<double> room_for_density() override;

    double density_kg_m3_;
    Vec3 body_force_;
    NoSlipAnswer answer_;
    // The velocities of the cells that the markers of the last spread felt.
    std::vector<double> felt_;
    // One value per cell: the density over that at rest in the cells of velocity_ and of
    // felt_.
    std::vector<double> relative_density_, felt_density_;
    std::vector<Vec3> volume_;  // work array; volumes in the first component
};

}  // namespace magfsi::coupler
