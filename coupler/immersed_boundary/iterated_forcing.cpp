#include "coupler/immersed_boundary/iterated_forcing.h"

#include <algorithm>

namespace magfsi::coupler {

IteratedForcing::IteratedForcing(std::span<const Marker> markers,
                                 const PenaltyScale& scale)
    : coupled_step_s_(scale.coupled_step_s),
      last_(markers.size()),
      impulse_(markers.size()) {
    moved_mass_kg_.reserve(markers.size());
    const double share = std::min(scale.strength, 1.0);
    for (const Marker& m : markers)
        moved_mass_kg_.push_back(share * 2 * scale.fluid_density_kg_m3 * m.volume_m3);
}

void IteratedForcing::begin_step() {
    std::ranges::fill(impulse_, Vec3{});
}

std::span<const Vec3> IteratedForcing::correct(std::span<const Vec3> before_m,
                                               std::span<const Vec3> now_m,
                                               std::span<const Vec3> fluid_velocity) {
    for (std::size_t m = 0; m < last_.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) {
            const double mean = (now_m[m][d] - before_m[m][d]) / coupled_step_s_;
            last_[m][d] = moved_mass_kg_[m] * (mean - fluid_velocity[m][d]);
            impulse_[m][d] += last_[m][d];
        }
    }
    return last_;
}

std::vector<Vec3> IteratedForcing::added_to(std::span<const Vec3> of_drag) const {
    std::vector<Vec3> all(of_drag.begin(), of_drag.end());
    for (std::size_t m = 0; m < all.size(); ++m)
        for (std::size_t d = 0; d < 3; ++d) all[m][d] += impulse_[m][d];
    return all;
}

}  // namespace magfsi::coupler
