// SPDX-License-Identifier: GPL-2.0-or-later
// How well the markers of a body say what force each of them gives.
#pragma once

#include <span>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/options.h"

namespace magfsi::coupler {

// Condition number of the marker system over its row sums (no_slip.h), whose largest
// eigenvalue is 1, by power iteration from below: at least this. Large where markers
// crowd and their forces can cancel without the fluid's notice. volume_m3: of fluid that
// each moves.
double condition_number(const Grid& grid, Kernel kernel, std::span<const Vec3> points_m,
                        std::span<const double> volume_m3);

}  // namespace magfsi::coupler
