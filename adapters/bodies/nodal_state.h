// SPDX-License-Identifier: GPL-2.0-or-later
// The nodes of all bodies at one time.
#pragma once

#include <array>
#include <vector>

namespace magfsi::bodies {

using Vec3 = std::array<double, 3>;

// In the order of the bodies and of each body's nodes.
struct NodalState {
    std::vector<Vec3> position_m, velocity_m_s;
    std::vector<double> mass_kg;
};

}  // namespace magfsi::bodies
