// SPDX-License-Identifier: GPL-2.0-or-later
// Each node is tied by a spring to where it starts: LAMMPS's own fix spring/self, on all
// nodes. An elastic bed, or a gentle hand.
#include "docs/examples/tether/tether.h"

#include <fmt/format.h>

#include "structure/lammps/effect.h"

namespace magfsi::structure {

extern const Effect tether_effect{
    .name = "tether",
    .asked = [](const LammpsInput&) { return tether_n_m.has_value(); },
    .commands =
        [](Lines& lines, const LammpsInput&) {
            lines.push_back(
                fmt::format("fix tether all spring/self {:.17g}", *tether_n_m));
        }};

}  // namespace magfsi::structure
