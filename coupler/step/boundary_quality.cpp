#include "coupler/step/boundary_quality.h"

#include <fmt/format.h>

#include <algorithm>

namespace magfsi::coupler {

output::BoundarySummary boundary_summary(const SlipReport& slip,
                                         double given_speed_m_s) {
    output::BoundarySummary b;
    b.markers = slip.markers;
    b.samples = slip.samples;
    b.error_m_s = slip.error_m_s;
    b.largest_error_m_s = slip.largest_error_m_s;
    b.marker_speed_m_s = slip.marker_speed_m_s;
    b.leakage_m3_s = slip.leakage_m3_s;
    b.reference_speed_m_s = std::max(slip.marker_speed_m_s, given_speed_m_s);
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
