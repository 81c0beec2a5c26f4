// SPDX-License-Identifier: GPL-2.0-or-later
// The stable step of a body with springs on its surface.
#pragma once

#include "structure/body.h"

namespace magfsi::structure {

// Largest step [s] with step^2 (omega^2 + w) + 2 step c <= 4, omega and c the body's own
// largest frequency and damping (stable_step_s), w the largest stiffness * area / mass of
// a surface node: a bound, since the largest eigenvalue of a sum is at most the sum of
// the largest. Run at 0.9 of it. Throws as stable_step_s.
double step_limit_s(const Body& body, double stiffness_pa_m);

}  // namespace magfsi::structure
