// What the summary and the log say of how well the immersed boundary held.
#pragma once

#include <string>

#include "coupler/immersed_boundary/slip.h"
#include "coupler/output/summary.h"
#include "adapters/scene/scene.h"

namespace magfsi::coupler {

// Largest speed that the scene gives the fluid: of inlets, walls and the initial flow.
double given_flow_speed(const scene::Scene& scene);

// Relative to the larger of the markers' speed (rms) and the given flow's; the leakage to
// that speed times a quarter of the surface, the mean cross-section of a convex body.
output::BoundarySummary boundary_summary(const SlipReport& slip,
                                         const scene::Scene& scene);

std::string to_text(const output::BoundarySummary& boundary);

}  // namespace magfsi::coupler
