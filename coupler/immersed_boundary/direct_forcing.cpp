// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/direct_forcing.h"

#include <algorithm>
#include <cmath>

#include "coupler/immersed_boundary/running_mean.h"

namespace magfsi::coupler {

EnclosedFluid::EnclosedFluid(std::span<const Marker> markers,
                             const EnclosedFluidScale& scale)
    : scale_(scale),
      last_velocity_(markers.size()),
      mean_(markers.size()),
      mean_of_mean_(markers.size()),
      force_(markers.size()) {
    mass_kg_.reserve(markers.size());
    following_.reserve(markers.size());
    for (const Marker& m : markers) {
        mass_kg_.push_back(scale.fluid_density_kg_m3 * m.displaced_m3);
        const EnclosedFollow& follow = m.enclosed_follow.part >= scale.follow.part
                                           ? m.enclosed_follow
                                           : scale.follow;
        // In one step M takes on the share w of a change and 2 M - N the share 2 w - w^2;
        // w is chosen so that this share is follow.part.
        if (follow.without_lag)
            following_.push_back({1 - std::sqrt(1 - follow.part), 1});
        else
            following_.push_back({follow.part, 0});
    }
}

void EnclosedFluid::start(std::span<const Vec3> fluid_velocity) {
    last_velocity_.assign(fluid_velocity.begin(), fluid_velocity.end());
}

void EnclosedFluid::begin_step(std::span<const Vec3> fluid_velocity) {
    if (scale_.gravity_m_s2 != Vec3{})
        follow<true>(fluid_velocity);
    else
        follow<false>(fluid_velocity);
}

template <bool Weighs>
void EnclosedFluid::follow(std::span<const Vec3> fluid_velocity) {
    const double a_second = 1 / scale_.coupled_step_s;
    for (std::size_t m = 0; m < force_.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) {
            const double now = (fluid_velocity[m][d] - last_velocity_[m][d]) * a_second;
            double &mean = mean_[m][d], &mean_of_mean = mean_of_mean_[m][d];
            add_to_means(now, following_[m].weight, mean, mean_of_mean);
            double relative = mean + following_[m].twice * (mean - mean_of_mean);
            if constexpr (Weighs) relative -= scale_.gravity_m_s2[d];
            force_[m][d] = mass_kg_[m] * relative;
            last_velocity_[m][d] = fluid_velocity[m][d];
        }
    }
}

PenaltyForce::PenaltyForce(std::vector<Marker> markers, const PenaltyScale& scale,
                           const Vec3& gravity_m_s2)
    : markers_(std::move(markers)),
      enclosed_(markers_, {scale.fluid_density_kg_m3, scale.coupled_step_s, gravity_m_s2,
                           scale.enclosed_follow}),
      coupled_step_s_(scale.coupled_step_s),
      fluid_velocity_(markers_.size()),
      impulse_(markers_.size()) {
    kappa_.reserve(markers_.size());
    for (const Marker& m : markers_)
        kappa_.push_back(scale.drag_coefficient_kg_s(m.volume_m3));
}

void PenaltyForce::begin_step(std::span<const Vec3> fluid_velocity) {
    std::copy(fluid_velocity.begin(), fluid_velocity.end(), fluid_velocity_.begin());
    std::fill(impulse_.begin(), impulse_.end(), Vec3{});
    change_.clear();
    enclosed_.begin_step(fluid_velocity);
}

void PenaltyForce::let_change(std::span<const Vec3> start, std::span<const Vec3> end) {
    start_.assign(start.begin(), start.end());
    change_.assign(end.begin(), end.end());
    for (std::size_t m = 0; m < change_.size(); ++m) change_[m] -= start_[m];
    elapsed_s_ = 0;
}

void PenaltyForce::hold(std::span<const Vec3> fluid_velocity) {
    std::ranges::copy(fluid_velocity, fluid_velocity_.begin());
}

// The middle of the substep makes the mean of U over the step that of its line.
void PenaltyForce::follow(double duration_s) {
    const double part = (elapsed_s_ + 0.5 * duration_s) / coupled_step_s_;
    for (std::size_t m = 0; m < change_.size(); ++m)
        fluid_velocity_[m] = start_[m] + part * change_[m];
    elapsed_s_ += duration_s;
}

void PenaltyForce::apply(const double* nodal_velocity, double* nodal_force,
                         double duration_s) {
    if (!change_.empty()) follow(duration_s);
    const auto enclosed = enclosed_.force();
    for (std::size_t m = 0; m < markers_.size(); ++m) {
        const Vec3 velocity = at_marker(markers_[m], nodal_velocity);
        const Vec3 given = kappa_[m] * (velocity - fluid_velocity_[m]);
        impulse_[m] += given * duration_s;
        to_nodes(markers_[m], enclosed[m] - given, nodal_force);
    }
}

}  // namespace magfsi::coupler
