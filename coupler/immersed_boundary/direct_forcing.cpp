// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/direct_forcing.h"

#include <algorithm>
#include <cmath>

#include "coupler/immersed_boundary/running_mean.h"

namespace magfsi::coupler {

namespace {

constexpr std::array<MarkerKernel, 3> kernels{&sse2::apply_markers, &avx2::apply_markers,
                                              &avx512::apply_markers};

std::vector<int> nodes_of(std::span<const Marker> markers) {
    std::vector<int> nodes;
    for (const Marker& marker : markers)
        nodes.insert(nodes.end(), marker.node.begin(), marker.node.end());
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

// Number of the first markers that have the same nodes, at most most_in_run.
std::size_t run_length(std::span<const Marker> markers) {
    const std::size_t most = std::min<std::size_t>(markers.size(), most_in_run);
    std::size_t length = 1;
    while (length < most && markers[length].node == markers[0].node) ++length;
    return length;
}

}  // namespace

PackedMarkers::PackedMarkers(std::span<const Marker> markers, InstructionSet set)
    : kernel_(kernels[static_cast<std::size_t>(set)]),
      nodes_(nodes_of(markers)),
      rows_(nodes_.size()) {
    for (const Marker& marker : markers)
        weights_.insert(weights_.end(), marker.weight.begin(), marker.weight.end());
    for (std::size_t m = 0, length = 0; m < markers.size(); m += length) {
        length = run_length(markers.subspan(m));
        MarkerRun& run = runs_.emplace_back();
        for (std::size_t a = 0; a < 8; ++a)
            run.node[a] = &rows_[std::ranges::lower_bound(nodes_, markers[m].node[a]) -
                                 nodes_.begin()];
        const int count = static_cast<int>(length);
        if (blocks_.empty() || blocks_.back().markers != count)
            blocks_.push_back({count, 0});
        ++blocks_.back().runs;
    }
}

void PackedMarkers::substep(const MarkerValues& values, const double* nodal_velocity,
                            double* nodal_force, double duration_s) {
    const MarkerLayout layout{
        nodes_.data(), rows_.data(),   static_cast<int>(nodes_.size()), weights_.data(),
        runs_.data(),  blocks_.data(), static_cast<int>(blocks_.size())};
    kernel_(layout, values, nodal_velocity, nodal_force, duration_s);
}

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
                           const Vec3& gravity_m_s2, InstructionSet set)
    : markers_(std::move(markers)),
      packed_(markers_, set),
      enclosed_(markers_, {scale.fluid_density_kg_m3, scale.coupled_step_s, gravity_m_s2,
                           scale.enclosed_follow}),
      coupled_step_s_(scale.coupled_step_s),
      fluid_velocity_(markers_.size() + 1),
      enclosed_force_(markers_.size() + 1),
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
    std::ranges::copy(enclosed_.force(), enclosed_force_.begin());
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
    const auto now = flat(fluid_velocity_), start = flat(start_), change = flat(change_);
    for (std::size_t i = 0; i < change.size(); ++i) now[i] = start[i] + part * change[i];
    elapsed_s_ += duration_s;
}

void PenaltyForce::apply(const double* nodal_velocity, double* nodal_force,
                         double duration_s) {
    if (!change_.empty()) follow(duration_s);
    packed_.substep({kappa_.data(), flat(fluid_velocity_).data(),
                     flat(enclosed_force_).data(), flat(impulse_).data()},
                    nodal_velocity, nodal_force, duration_s);
}

}  // namespace magfsi::coupler
