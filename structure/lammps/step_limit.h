// The stable step of a body with springs on its surface.
#pragma once

#include "structure/body.h"

namespace magfsi::structure {

// 2 / sqrt(omega^2 + max over surface nodes of stiffness * area / mass) [s], omega =
// 2 / stable_step_s the body's own largest frequency: a bound, since the largest
// eigenvalue of a sum is at most the sum of the largest. Throws as stable_step_s.
double step_limit_s(const Body& body, double stiffness_pa_m);

}  // namespace magfsi::structure
