// What the summary and the log say of how well the immersed boundary held.
#pragma once

#include <string>

#include "coupler/immersed_boundary/slip.h"
#include "coupler/output/summary.h"

namespace magfsi::coupler {

// Relative to the larger of the markers' speed (rms) and the given flow's (RunPlan); the leakage to
// that speed times a quarter of the surface, the mean cross-section of a convex body.
output::BoundarySummary boundary_summary(const SlipReport& slip,
                                         double given_speed_m_s);

std::string to_text(const output::BoundarySummary& boundary);

}  // namespace magfsi::coupler
