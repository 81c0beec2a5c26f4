// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/fluid_side.h"

#include <utility>

namespace magfsi::coupler {

FluidSide::FluidSide(GridFluid& fluid, const std::vector<CellBox>& owned, Kernel kernel,
                     double coupled_step_s)
    : fluid_(fluid),
      coupled_step_s_(coupled_step_s),
      spread_rows_(fluid.grid(), owned, kernel),
      sample_rows_(fluid.grid(), owned, kernel),
      owned_(owned),
      kernel_(kernel) {}

bool FluidSide::own(const std::vector<CellBox>& boxes) {
    if (boxes == owned_) return false;
    owned_ = boxes;
    spread_rows_ = TouchedRows(fluid_.grid(), boxes, kernel_);
    sample_rows_ = TouchedRows(fluid_.grid(), boxes, kernel_);
    return true;
}

void FluidSide::spread(std::span<const Vec3> points_m, std::span<const Vec3> impulse) {
    // Impulses usually act where the velocities were sampled last; in a step that is
    // repeated they act where they acted before.
    bool known = false;
    if (!spread_rows_.placed_at(points_m)) {
        if (sample_rows_.placed_at(points_m)) {
            std::swap(spread_rows_, sample_rows_);
            known = read_now_;
        } else {
            spread_rows_.place(points_m);
        }
    }
    note_felt(known);
    density_.assign(3 * spread_rows_.cells(), 0.0);
    spread_rows_.spread(impulse, coupled_step_s_, density_);
    fluid_.set_force(spread_rows_.rows(), density_);
}

std::span<const Vec3> FluidSide::sample(std::span<const Vec3> points_m,
                                        std::span<const double> /*volume_m3*/) {
    sample_rows_.place(points_m);
    velocity_.resize(3 * sample_rows_.cells());
    fluid_.velocity(sample_rows_.rows(), velocity_, room_for_density());
    read_now_ = true;
    sampled_.resize(points_m.size());
    sample_rows_.interpolate(velocity_, sampled_);
    return sampled_;
}

InterfaceBalance FluidSide::received() {
    std::vector<double> velocity(3 * spread_rows_.cells());
    fluid_.velocity(spread_rows_.rows(), velocity, {});
    return received(velocity);
}

InterfaceBalance FluidSide::received(std::span<const double> velocity) const {
    const double h = fluid_.grid().spacing_m;
    const double impulse_of_density = h * h * h * coupled_step_s_;
    InterfaceBalance b;
    for (std::size_t i = 0; i < density_.size(); ++i) {
        const double impulse = density_[i] * impulse_of_density;
        b.impulse_n_s[i % 3] += impulse;
        b.work_j += impulse * velocity[i];
    }
    return b;
}

NoSlipFluidSide::NoSlipFluidSide(GridFluid& fluid, const std::vector<CellBox>& owned,
                                 Kernel kernel, double coupled_step_s,
                                 double density_kg_m3, const Vec3& body_force)
    : FluidSide(fluid, owned, kernel, coupled_step_s),
      density_kg_m3_(density_kg_m3),
      body_force_(body_force) {}

void NoSlipFluidSide::note_felt(bool known) {
    if (known) {
        felt_ = velocity_;
        felt_density_ = relative_density_;
        return;
    }
    felt_.resize(3 * spread_rows_.cells());
    felt_density_.resize(spread_rows_.cells());
    fluid_.velocity(spread_rows_.rows(), felt_, felt_density_);
}

// q = U + F dt / (2 rho) in each cell, with the cell's own density, interpolated to the
// markers.
void NoSlipFluidSide::spread(std::span<const Vec3> points_m,
                             std::span<const Vec3> impulse) {
    FluidSide::spread(points_m, impulse);
    const double half_s = coupled_step_s_ / (2 * density_kg_m3_);
    std::vector<double> passing(density_.size());
    for (std::size_t i = 0; i < passing.size(); ++i) {
        passing[i] =
            felt_[i] + half_s / felt_density_[i / 3] * (density_[i] + body_force_[i % 3]);
    }
    answer_.make_room(points_m.size());
    spread_rows_.interpolate(passing, answer_.passed);
}

std::span<double> NoSlipFluidSide::room_for_density() {
    relative_density_.resize(sample_rows_.cells());
    return relative_density_;
}

// The row sums are the marker system applied to ones: volumes spread and interpolated
// back. Before the first step q is zero.
std::span<const Vec3> NoSlipFluidSide::sample(std::span<const Vec3> points_m,
                                              std::span<const double> volume_m3) {
    const auto sampled = FluidSide::sample(points_m);
    volume_.assign(volume_m3.size(), Vec3{});
    for (std::size_t m = 0; m < volume_m3.size(); ++m) volume_[m][0] = volume_m3[m];
    std::vector<double> share(3 * sample_rows_.cells());
    sample_rows_.spread(volume_, 1, share);
    sample_rows_.interpolate(share, volume_);
    answer_.make_room(points_m.size());
    for (std::size_t m = 0; m < volume_.size(); ++m) answer_.row_sum[m] = volume_[m][0];
    return sampled;
}

}  // namespace magfsi::coupler
