// SPDX-License-Identifier: GPL-2.0-or-later
// Gravity by LAMMPS's own fix gravity, which scales with each node's mass.
#include <fmt/format.h>

#include <cmath>

#include "structure/lammps/effect.h"

namespace magfsi::structure {

extern const Effect gravity_effect{
    .name = "gravity",
    .asked = [](const LammpsInput& input) { return input.gravity_m_s2.has_value(); },
    .commands =
        [](Lines& lines, const LammpsInput& input) {
            const auto& [gx, gy, gz] = *input.gravity_m_s2;
            const double magnitude = std::hypot(gx, gy, gz);
            if (!(magnitude > 0)) return;
            lines.push_back(fmt::format(
                "fix gravity all gravity {:.17g} vector {:.17g} {:.17g} {:.17g}",
                magnitude, gx, gy, gz));
        }};

}  // namespace magfsi::structure
