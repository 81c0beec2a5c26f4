// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/fluid_side.h"

#include <utility>

namespace magfsi::coupler {

FluidSide::FluidSide(GridFluid& fluid, const std::vector<CellBox>& owned, Kernel kernel,
                     double coupled_step_s, Forcing forcing)
    : fluid_(fluid),
      owned_(owned),
      kernel_(kernel),
      coupled_step_s_(coupled_step_s),
      forcing_(forcing),
      spread_rows_(fluid.grid(), owned, kernel),
      sample_rows_(fluid.grid(), owned, kernel) {}

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
    if (forcing_ == Forcing::no_slip && known) {
        felt_ = velocity_;
        felt_density_ = relative_density_;
    } else if (forcing_ == Forcing::no_slip) {
        felt_.resize(3 * spread_rows_.cells());
        felt_density_.resize(spread_rows_.cells());
        fluid_.velocity(spread_rows_.rows(), felt_, felt_density_);
    }
    density_.assign(3 * spread_rows_.cells(), 0.0);
    spread_rows_.spread(impulse, coupled_step_s_, density_);
    fluid_.set_force(spread_rows_.rows(), density_);
}

std::span<const Vec3> FluidSide::sample(std::span<const Vec3> points_m) {
    sample_rows_.place(points_m);
    velocity_.resize(3 * sample_rows_.cells());
    if (forcing_ == Forcing::no_slip) relative_density_.resize(sample_rows_.cells());
    fluid_.velocity(sample_rows_.rows(), velocity_, relative_density_);
    read_now_ = true;
    sampled_.resize(points_m.size());
    sample_rows_.interpolate(velocity_, sampled_);
    return sampled_;
}

// q = U + F dt / (2 rho) in each cell, with the cell's own density, interpolated to the
// markers.
void FluidSide::add_passed(double density_kg_m3, const Vec3& body_force,
                           NoSlipAnswer& answer) {
    const double half_s = coupled_step_s_ / (2 * density_kg_m3);
    std::vector<double> passing(density_.size());
    for (std::size_t i = 0; i < passing.size(); ++i) {
        passing[i] =
            felt_[i] + half_s / felt_density_[i / 3] * (density_[i] + body_force[i % 3]);
    }
    spread_rows_.interpolate(passing, answer.passed);
}

// The row sums are the marker system applied to ones: volumes spread and interpolated
// back.
void FluidSide::add_row_sums(std::span<const double> volume_m3, NoSlipAnswer& answer) {
    volume_.assign(volume_m3.size(), Vec3{});
    for (std::size_t m = 0; m < volume_m3.size(); ++m) volume_[m][0] = volume_m3[m];
    std::vector<double> share(3 * sample_rows_.cells());
    sample_rows_.spread(volume_, 1, share);
    sample_rows_.interpolate(share, volume_);
    for (std::size_t m = 0; m < volume_.size(); ++m) answer.row_sum[m] = volume_[m][0];
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

}  // namespace magfsi::coupler
