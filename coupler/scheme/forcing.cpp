// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/scheme/forcing.h"

#include <algorithm>

#include "base/fitted/constants.h"

namespace magfsi::coupler {

std::vector<Vec3> MarkerStep::mean_velocity() const {
    std::vector<Vec3> all(now_m.size());
    for (std::size_t m = 0; m < all.size(); ++m)
        all[m] = (now_m[m] - before_m[m]) / duration_s;
    return all;
}

PenaltyForcing::PenaltyForcing(std::vector<Marker> markers, const PenaltyScale& scale,
                               const Vec3& gravity_m_s2, const MarkerStep& step)
    : PenaltyForce(std::move(markers), scale, gravity_m_s2), step_(step) {}

void PenaltyForcing::start(bool fresh) {
    if (fresh) enclosed().start(step_.fluid_velocity);
}

void PenaltyForcing::measure(SlipRecord& record) const {
    step_.solver.renew_ghost_velocities();
    std::vector<Vec3> velocity;
    for (const Marker& marker : markers())
        velocity.push_back(at_marker(marker, step_.solver.velocities()));
    record.add(markers(), step_.fluid_velocity, velocity, step_.solver.positions());
}

std::vector<MarkerArray> PenaltyForcing::carried() {
    return {{"enclosed_velocity", flat(enclosed().last_velocity())},
            {"enclosed_acceleration", flat(enclosed().mean())},
            {"enclosed_mean_acceleration", flat(enclosed().mean_of_mean())}};
}

NoSlipForcing::NoSlipForcing(std::vector<Marker> markers, const PenaltyScale& scale,
                             const Vec3& gravity_m_s2, const MarkerStep& step,
                             const Setting& setting)
    : PenaltyForcing(std::move(markers), scale, gravity_m_s2, step),
      scale_(scale),
      body_force_n_m3_(setting.body_force_n_m3),
      incompressible_(setting.incompressible),
      memory_(this->markers(), setting.rates) {
    for (const Marker& marker : this->markers()) volume_m3_.push_back(marker.volume_m3);
    if (setting.carries_layers)
        layer_.emplace(this->markers(), setting.areas, scale.fluid_density_kg_m3);
}

void NoSlipForcing::begin_step(std::span<const Vec3> fluid_velocity) {
    PenaltyForce::begin_step(fluid_velocity);
    hold(fluid_velocity);
}

void NoSlipForcing::let_change(std::span<const Vec3> start, std::span<const Vec3> end) {
    PenaltyForce::let_change(memory_.felt(start), memory_.felt(end));
}

void NoSlipForcing::hold(std::span<const Vec3> fluid_velocity) {
    PenaltyForce::hold(memory_.felt(fluid_velocity));
}

void NoSlipForcing::start(bool fresh) {
    PenaltyForcing::start(fresh);
    divide_by_row_sums();
    if (fresh && layer_) layer_->start(step_.fluid_velocity, step_.solver.positions());
}

void NoSlipForcing::add_to_advance(TaskList& tasks) {
    if (!layer_) return;
    tasks.add_coupling("carry layers", [this] {
        layer_->add(impulse(), step_.mean_velocity(), step_.solver.positions());
    });
}

void NoSlipForcing::add_to_answer(TaskList& tasks) {
    tasks.add_coupling("remember slip", [this] { take_answer(); });
}

// In an incompressible fluid nothing is remembered: the step has been repeated until the
// fluid moved with the body. Else the body force's part of q - U is left out of g. U is
// that at the start of the step.
void NoSlipForcing::take_answer() {
    if (incompressible_) {
        answer_.passed = step_.fluid_velocity;
        return divide_by_row_sums();
    }
    const std::span<const Vec3> felt = step_.last_velocity;
    const double half_m3_kg = 0.5 / scale_.fluid_density_kg_m3;
    const Vec3 of_all = half_m3_kg * step_.duration_s * body_force_n_m3_;
    const std::span<const Vec3> given = this->given();
    std::vector<Vec3> uneven(felt.size());
    for (std::size_t m = 0; m < felt.size(); ++m) {
        const double even = half_m3_kg * answer_.row_sum[m] / volume_m3_[m];
        uneven[m] = even * given[m] - (answer_.passed[m] - of_all - felt[m]);
    }
    memory_.add(step_.mean_velocity(), answer_.passed, uneven);
    divide_by_row_sums();
}

// Row sums are bounded from below, since the stable substep depends on the largest kappa.
void NoSlipForcing::divide_by_row_sums() {
    for (std::size_t m = 0; m < kappa_.size(); ++m)
        kappa_[m] = fitted::no_slip_strength *
                    scale_.drag_coefficient_kg_s(volume_m3_[m]) /
                    std::max(answer_.row_sum[m], fitted::least_row_sum);
}

std::span<const Vec3> NoSlipForcing::given() const {
    return layer_ ? layer_->given() : impulse();
}

void NoSlipForcing::measure(SlipRecord& record) const {
    record.add(markers(), answer_.passed, step_.mean_velocity(),
               step_.solver.positions());
}

std::vector<MarkerArray> NoSlipForcing::carried() {
    std::vector<MarkerArray> all = PenaltyForcing::carried();
    all.push_back({"slip_memory", flat(memory_.values())});
    if (layer_) {
        all.push_back({"layer_velocity_along", flat(layer_->last_along())});
        all.push_back({"layer_change", flat(layer_->mean())});
        all.push_back({"layer_mean_change", flat(layer_->mean_of_mean())});
    }
    return all;
}

}  // namespace magfsi::coupler
