// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes that keep their place along some axes and not along all.
#include <fmt/format.h>

#include <algorithm>

#include "structure/lammps/effect.h"
#include "structure/lammps/names.h"

namespace magfsi::structure {

namespace {

std::vector<int> rolling_ids(const LammpsInput& input, std::size_t axis) {
    return ids_where(input, [&](const HeldAxes& held) {
        return held[axis] && held != HeldAxes{true, true, true};
    });
}

// After every fix that adds forces, as LAMMPS calls them in the order of the script; at
// rest along the axis at first, the nodes stay so. The fluid's force comes earlier in the
// step, before the forces of ghosts are summed.
void add_rollers(Lines& lines, const LammpsInput& input) {
    if (input.reactions) lines.push_back("fix before_rollers all store/force");
    for (std::size_t d = 0; d < 3; ++d) {
        const std::vector<int> ids = rolling_ids(input, d);
        if (ids.empty()) continue;
        const std::string group = held_group(d);
        lines.push_back(fmt::format("group {} id {}", group, id_ranges(ids)));
        lines.push_back(fmt::format("fix {0} {0} setforce {1} {2} {3}", group,
                                    d == 0 ? "0.0" : "NULL", d == 1 ? "0.0" : "NULL",
                                    d == 2 ? "0.0" : "NULL"));
    }
}

}  // namespace

extern const Effect rollers_effect{
    .name = "rollers",
    .asked =
        [](const LammpsInput& input) {
            return std::ranges::any_of(
                input.bodies, [](const Body& body) { return !body.rollers.empty(); });
        },
    .commands = add_rollers};

}  // namespace magfsi::structure
