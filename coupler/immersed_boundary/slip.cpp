// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/slip.h"

#include <algorithm>
#include <cmath>

namespace magfsi::coupler {

namespace {

// One edge vector of a piece of surface [m].
Vec3 edge(const Marker& marker, const std::array<double, 8>& weight,
          const double* nodal) {
    Marker along = marker;
    along.weight = weight;
    return at_marker(along, nodal);
}

}  // namespace

Vec3 area_vector(const Marker& marker, const MarkerArea& area, const double* nodal) {
    return cross(edge(marker, area.first, nodal), edge(marker, area.second, nodal));
}

void SlipRecord::add(std::span<const Marker> markers,
                     std::span<const Vec3> fluid_velocity, std::span<const Vec3> velocity,
                     const double* position) {
    markers_ = markers.size();
    double& slip2 = slip2_.emplace_back(0);
    for (std::size_t m = 0; m < markers.size(); ++m) {
        const Vec3 slip = fluid_velocity[m] - velocity[m];
        slip2 += dot(slip, slip);
        speed2_ += dot(velocity[m], velocity[m]);
    }
    surface_m2_ = 0;
    for (const MarkerArea& area : areas_) {
        const std::size_t m = area.marker;
        const Vec3 a = area_vector(markers[m], area, position);
        const Vec3 slip = fluid_velocity[m] - velocity[m];
        leakage_m3_s_ += 0.5 * std::abs(dot(slip, a));
        surface_m2_ += std::sqrt(dot(a, a));
    }
}

SlipReport SlipRecord::collect(MPI_Comm comm) const {
    SlipReport report{markers_, static_cast<std::int64_t>(slip2_.size())};
    MPI_Allreduce(MPI_IN_PLACE, &report.markers, 1, MPI_INT64_T, MPI_SUM, comm);
    std::vector<double> sums(slip2_);
    sums.insert(sums.end(), {speed2_, leakage_m3_s_, surface_m2_});
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), sums.size(), MPI_DOUBLE, MPI_SUM, comm);
    if (report.samples == 0 || report.markers == 0) return report;
    const double samples = report.samples;
    const double markers = report.markers;
    double total = 0, largest = 0;
    for (std::size_t s = 0; s < slip2_.size(); ++s) {
        total += sums[s];
        largest = std::max(largest, sums[s]);
    }
    const double* rest = sums.data() + slip2_.size();
    report.error_m_s = std::sqrt(total / (samples * markers));
    report.largest_error_m_s = std::sqrt(largest / markers);
    report.marker_speed_m_s = std::sqrt(rest[0] / (samples * markers));
    report.leakage_m3_s = rest[1] / samples;
    report.surface_m2 = rest[2];
    return report;
}

}  // namespace magfsi::coupler
