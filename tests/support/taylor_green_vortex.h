// SPDX-License-Identifier: GPL-2.0-or-later
// The Taylor-Green vortex at its start, of speed, wave number and density 1, in a
// periodic cube of side 2 pi.
#pragma once

#include <cmath>

#include "fluid_lbm/fluid.h"

namespace magfsi::fluid {

inline void start_as_taylor_green_vortex(FluidConfig& config) {
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{std::sin(x[0]) * std::cos(x[1]) * std::cos(x[2]),
                    -std::cos(x[0]) * std::sin(x[1]) * std::cos(x[2]), 0};
    };
    config.initial_pressure = [](const Vec3& x) {
        return (std::cos(2 * x[0]) + std::cos(2 * x[1])) * (std::cos(2 * x[2]) + 2) / 16;
    };
}

}  // namespace magfsi::fluid
