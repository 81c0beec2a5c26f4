// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/balance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace magfsi::coupler {

static_assert(sizeof(InterfaceBalance) == balance_values * sizeof(double));

namespace {

double length(const Vec3& v) {
    return std::sqrt(dot(v, v));
}

// A difference without a scale counts as infinite, and so does NaN.
double relative(double difference, double scale) {
    if (difference == 0) return 0;
    const double ratio = difference / scale;
    return std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;
}

}  // namespace

void add_marker(InterfaceBalance& sum, const Vec3& impulse, const Vec3& fluid_velocity) {
    sum.impulse_n_s += impulse;
    for (std::size_t d = 0; d < 3; ++d) {
        sum.work_j += impulse[d] * fluid_velocity[d];
        sum.work_scale_j += std::abs(impulse[d] * fluid_velocity[d]);
    }
    sum.impulse_scale_n_s += length(impulse);
}

std::vector<double> BalanceRecord::values() const {
    std::vector<double> all;
    for (const InterfaceBalance& b : steps_) {
        all.insert(all.end(), {b.impulse_n_s[0], b.impulse_n_s[1], b.impulse_n_s[2],
                               b.work_j, b.impulse_scale_n_s, b.work_scale_j});
    }
    return all;
}

void BalanceRecord::set(std::span<const double> values) {
    steps_.clear();
    for (std::size_t at = 0; at + balance_values <= values.size(); at += balance_values) {
        const double* v = values.data() + at;
        steps_.push_back({vector_at(v), v[3], v[4], v[5]});
    }
}

std::vector<double> BalanceRecord::collect(MPI_Comm comm) {
    const std::vector<double> mine = values();
    steps_.clear();
    std::vector<double> all(mine.size());
    MPI_Reduce(mine.data(), all.data(), mine.size(), MPI_DOUBLE, MPI_SUM, 0, comm);
    return all;
}

Mismatch worst_mismatch(std::span<const double> given, std::span<const double> received) {
    Mismatch worst;
    for (std::size_t at = 0; at + balance_values <= given.size(); at += balance_values) {
        const double momentum = length(vector_at(&given[at]) - vector_at(&received[at]));
        const double power = std::abs(given[at + 3] - received[at + 3]);
        worst.momentum = std::max(worst.momentum, relative(momentum, given[at + 4]));
        worst.power = std::max(worst.power, relative(power, given[at + 5]));
    }
    return worst;
}

Vec3 impulse_of(std::span<const double> steps) {
    Vec3 sum{};
    for (std::size_t at = 0; at + balance_values <= steps.size(); at += balance_values)
        sum += vector_at(&steps[at]);
    return sum;
}

MarkerWork::MarkerWork(std::size_t markers)
    : works_(markers),
      last_fluid_force_(markers),
      last_enclosed_force_(markers),
      impulse_before_(markers) {}

void MarkerWork::begin_step() {
    std::ranges::fill(impulse_before_, Vec3{});
}

// The coupling force is the change of the impulse over the substep with the sign
// reversed; the trapezoidal rule weighs the forces at both ends.
void MarkerWork::add_substep(const PenaltyForce& force, const double* nodal_velocity,
                             double duration_s) {
    const auto impulse = force.impulse();
    const auto enclosed = force.enclosed().force();
    for (std::size_t m = 0; m < works_.size(); ++m) {
        const Vec3 v = at_marker(force.markers()[m], nodal_velocity);
        for (std::size_t d = 0; d < 3; ++d) {
            const double fluid = (impulse_before_[m][d] - impulse[m][d]) / duration_s;
            const double way = 0.5 * duration_s * v[d];
            works_[m][0] += way * (last_fluid_force_[m][d] + fluid);
            works_[m][1] += way * (last_enclosed_force_[m][d] + enclosed[m][d]);
            last_fluid_force_[m][d] = fluid;
        }
        impulse_before_[m] = impulse[m];
        last_enclosed_force_[m] = enclosed[m];
    }
}

void MarkerWork::add_given(std::span<const Vec3> given, std::span<const Vec3> paid,
                           std::span<const Vec3> mean_velocity) {
    for (std::size_t m = 0; m < works_.size(); ++m)
        for (std::size_t d = 0; d < 3; ++d)
            works_[m][2] += (given[m][d] - paid[m][d]) * mean_velocity[m][d];
}

double MarkerWork::sum(std::size_t which) const {
    double all = 0;
    for (const Vec3& work : works_) all += work[which];
    return all;
}

}  // namespace magfsi::coupler
