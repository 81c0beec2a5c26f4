#include "coupler/immersed_boundary/penalty_force.h"

#include <algorithm>

#include "coupler/immersed_boundary/penalty_kernel.h"

namespace magfsi::coupler {

PenaltyForce::PenaltyForce(std::vector<Marker> markers, const PenaltyScale& scale,
                           const Vec3& gravity_m_s2)
    : markers_(std::move(markers)),
      enclosed_(markers_, {scale.fluid_density_kg_m3, scale.coupled_step_s, gravity_m_s2,
                           scale.enclosed_follow}),
      coupled_step_s_(scale.coupled_step_s),
      fluid_velocity_(markers_.size()),
      impulse_(markers_.size()) {
    kappa_.reserve(markers_.size());
    for (const Marker& m : markers_) kappa_.push_back(scale.coefficient(m));
}

void PenaltyForce::begin_step(std::span<const Vec3> fluid_velocity,
                              std::span<const Vec3> owed) {
    std::copy(fluid_velocity.begin(), fluid_velocity.end(), fluid_velocity_.begin());
    std::fill(impulse_.begin(), impulse_.end(), Vec3{});
    change_.clear();
    enclosed_.begin_step(fluid_velocity);
    if (owed.empty()) return;
    paying_.assign(enclosed_.force().begin(), enclosed_.force().end());
    for (std::size_t m = 0; m < owed.size(); ++m)
        for (std::size_t d = 0; d < 3; ++d) paying_[m][d] -= owed[m][d] / coupled_step_s_;
}

void PenaltyForce::let_change(std::span<const Vec3> start, std::span<const Vec3> end) {
    start_.assign(start.begin(), start.end());
    change_.assign(end.begin(), end.end());
    for (std::size_t m = 0; m < change_.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) change_[m][d] -= start_[m][d];
    }
    elapsed_s_ = 0;
}

void PenaltyForce::hold(std::span<const Vec3> fluid_velocity) {
    std::ranges::copy(fluid_velocity, fluid_velocity_.begin());
}

void PenaltyForce::follow(double duration_s) {
    const double part = (elapsed_s_ + 0.5 * duration_s) / coupled_step_s_;
    for (std::size_t m = 0; m < change_.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d)
            fluid_velocity_[m][d] = start_[m][d] + part * change_[m][d];
    }
    elapsed_s_ += duration_s;
}

void PenaltyForce::apply(const double* nodal_velocity, double* nodal_force,
                         double duration_s) {
    if (!change_.empty()) follow(duration_s);
    pull_nodes({markers_, kappa_, fluid_velocity_, constant_force()}, nodal_velocity,
               duration_s, nodal_force, impulse_);
}

}  // namespace magfsi::coupler
