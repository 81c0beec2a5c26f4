// SPDX-License-Identifier: GPL-2.0-or-later
// The stiffness of a platform.
#pragma once

#include <span>

#include "structure/body.h"

namespace magfsi::structure {

// (lambda + 2 G) / (2 thickness): twice as soft as the material under a rigid plate. The
// penetration under the pressure p is 2 p / (lambda + 2 G) of the thickness, below 1 % up
// to p = (lambda + 2 G) / 200 (lambda = 20 G: 0.11 G). Weight (rho g h, 1e-4 G for a soft
// sheet) and field (|M| |B|, a few hundredths of G) stay below. Throws
// std::invalid_argument on a thickness that is not positive.
double platform_stiffness_pa_m(const Material& material, double thickness_m);

// With a missing stiffness put in: the largest
// platform_stiffness_pa_m of the bodies' materials (thickness: the mesh's smallest
// extent).
Platform with_stiffness(const Platform& platform, std::span<const Body> bodies);

}  // namespace magfsi::structure
