#include "coupler/step/boundary_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace magfsi::coupler {

double given_flow_speed(const scene::Scene& scene) {
    double largest = 0;
    const auto look_at = [&](const Vec3& v) {
        largest = std::max(largest, std::hypot(v[0], v[1], v[2]));
    };
    for (const scene::Boundary& side : scene.fluid->boundaries)
        look_at(side.velocity_m_s);
    if (scene.fluid->initial_velocity_m_s) look_at(*scene.fluid->initial_velocity_m_s);
    return largest;
}

output::BoundarySummary boundary_summary(const SlipReport& slip,
                                         const scene::Scene& scene) {
    output::BoundarySummary b;
    b.markers = slip.markers;
    b.samples = slip.samples;
    b.error_m_s = slip.error_m_s;
    b.largest_error_m_s = slip.largest_error_m_s;
    b.marker_speed_m_s = slip.marker_speed_m_s;
    b.leakage_m3_s = slip.leakage_m3_s;
    b.reference_speed_m_s = std::max(slip.marker_speed_m_s, given_flow_speed(scene));
    if (b.reference_speed_m_s > 0) {
        b.error = b.error_m_s / b.reference_speed_m_s;
        if (slip.surface_m2 > 0)
            b.leakage = b.leakage_m3_s / (b.reference_speed_m_s * 0.25 * slip.surface_m2);
    }
    return b;
}

std::string to_text(const output::BoundarySummary& b) {
    return fmt::format(
        "immersed boundary: no-slip error {:.2g} %, leakage {:.2g} % of {:.3g} m/s "
        "({} markers, {} samples)",
        100 * b.error, 100 * b.leakage, b.reference_speed_m_s, b.markers, b.samples);
}

}  // namespace magfsi::coupler
