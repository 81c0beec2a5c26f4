// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/layer_inertia.h"

#include <algorithm>

#include "base/fitted/constants.h"
#include "coupler/immersed_boundary/running_mean.h"

namespace magfsi::coupler {

namespace {

// The part of v parallel to a surface; the normal may have any length.
Vec3 along(const Vec3& v, const Vec3& normal) {
    return v - dot(v, normal) / dot(normal, normal) * normal;
}

}  // namespace

LayerInertia::LayerInertia(std::span<const Marker> markers,
                           std::span<const MarkerArea> areas, double fluid_density_kg_m3)
    : last_along_(markers.size()),
      mean_(markers.size()),
      mean_of_mean_(markers.size()),
      given_(markers.size()) {
    for (const MarkerArea& area : areas) {
        const Marker& marker = markers[area.marker];
        if (marker.beyond_m3 != 0)
            layer_.push_back({marker, area, fluid_density_kg_m3 * marker.beyond_m3});
    }
}

void LayerInertia::start(std::span<const Vec3> fluid_velocity, const double* position) {
    for (const Beyond& beyond : layer_) {
        const std::size_t m = beyond.area.marker;
        last_along_[m] =
            along(fluid_velocity[m], area_vector(beyond.marker, beyond.area, position));
    }
}

void LayerInertia::add(std::span<const Vec3> impulse, std::span<const Vec3> mean_velocity,
                       const double* position) {
    std::ranges::copy(impulse, given_.begin());
    for (const Beyond& beyond : layer_) {
        const std::size_t m = beyond.area.marker;
        const Vec3 now =
            along(mean_velocity[m], area_vector(beyond.marker, beyond.area, position));
        for (std::size_t d = 0; d < 3; ++d) {
            const double change = now[d] - last_along_[m][d];
            add_to_means(change, fitted::layer_weight, mean_[m][d], mean_of_mean_[m][d]);
            given_[m][d] += beyond.mass_kg * (2 * mean_[m][d] - mean_of_mean_[m][d]);
        }
        last_along_[m] = now;
    }
}

}  // namespace magfsi::coupler
