#include "adapters/lammps/audit/marker_work.h"

#include <algorithm>

namespace magfsi::lammps {

MarkerWork::MarkerWork(std::size_t markers)
    : works_(markers),
      last_fluid_force_(markers),
      last_enclosed_force_(markers),
      impulse_before_(markers) {}

void MarkerWork::begin_step() {
    std::ranges::fill(impulse_before_, Vec3{});
}

void MarkerWork::add_substep(const coupler::PenaltyForce& force,
                             const double* nodal_velocity, double duration_s) {
    const auto impulse = force.impulse();
    const auto constant = force.constant_force();
    const auto enclosed = force.enclosed().force();
    for (std::size_t m = 0; m < works_.size(); ++m) {
        const Vec3 v = coupler::at_marker(force.markers()[m], nodal_velocity);
        for (std::size_t d = 0; d < 3; ++d) {
            const double fluid = constant[m][d] - enclosed[m][d] -
                                 (impulse[m][d] - impulse_before_[m][d]) / duration_s;
            const double way = 0.5 * duration_s * v[d];
            works_[m][0] += way * (last_fluid_force_[m][d] + fluid);
            works_[m][1] += way * (last_enclosed_force_[m][d] + enclosed[m][d]);
            last_fluid_force_[m][d] = fluid;
        }
        impulse_before_[m] = impulse[m];
        last_enclosed_force_[m] = enclosed[m];
    }
}

double MarkerWork::sum(std::size_t which) const {
    double all = 0;
    for (const Vec3& work : works_) all += work[which];
    return all;
}

}  // namespace magfsi::lammps
