#include "coupler/immersed_boundary/balance.h"

#include <algorithm>
#include <cmath>

namespace magfsi::coupler {

static_assert(sizeof(InterfaceBalance) == balance_values * sizeof(double));

namespace {

double norm(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

}  // namespace

void add_marker(InterfaceBalance& sum, const Vec3& impulse, const Vec3& fluid_velocity) {
    for (std::size_t d = 0; d < 3; ++d) {
        sum.impulse_n_s[d] += impulse[d];
        sum.work_j += impulse[d] * fluid_velocity[d];
        sum.work_scale_j += std::abs(impulse[d] * fluid_velocity[d]);
    }
    sum.impulse_scale_n_s += norm(impulse[0], impulse[1], impulse[2]);
}

std::vector<double> BalanceRecord::collect(MPI_Comm comm) {
    std::vector<double> mine;
    for (const InterfaceBalance& b : steps_) {
        mine.insert(mine.end(), {b.impulse_n_s[0], b.impulse_n_s[1], b.impulse_n_s[2],
                                 b.work_j, b.impulse_scale_n_s, b.work_scale_j});
    }
    steps_.clear();
    std::vector<double> all(mine.size());
    MPI_Reduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, 0,
               comm);
    return all;
}

Mismatch worst_mismatch(std::span<const double> given, std::span<const double> received) {
    Mismatch worst;
    for (std::size_t at = 0; at + balance_values <= given.size(); at += balance_values) {
        const double momentum = norm(given[at] - received[at], given[at + 1] - received[at + 1],
                                     given[at + 2] - received[at + 2]);
        const double power = std::abs(given[at + 3] - received[at + 3]);
        const double momentum_scale = given[at + 4];
        const double power_scale = given[at + 5];
        if (momentum_scale > 0) worst.momentum = std::max(worst.momentum, momentum / momentum_scale);
        if (power_scale > 0) worst.power = std::max(worst.power, power / power_scale);
    }
    return worst;
}

}  // namespace magfsi::coupler
