// SPDX-License-Identifier: GPL-2.0-or-later
// Conditioning of the marker system: how uniquely the fluid's velocities determine the
// markers' forces.
#pragma once

#include <span>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/options.h"

namespace magfsi::coupler {

// Lower bound of the condition number of the marker system divided by its row sums
// (no_slip.h). The largest eigenvalue of that matrix is 1; the smallest one is approached
// from above by power iteration on the identity less the matrix. The number is large
// where markers crowd, so that their forces can cancel without any effect on the fluid.
// points_m: positions [m]; volume_m3: fluid that each marker moves [m3].
double condition_number(const Grid& grid, Kernel kernel, std::span<const Vec3> points_m,
                        std::span<const double> volume_m3);

}  // namespace magfsi::coupler
