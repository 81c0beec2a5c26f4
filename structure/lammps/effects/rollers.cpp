// SPDX-License-Identifier: GPL-2.0-or-later
// Rollers: nodes that are held along some axes but not along all.
#include <fmt/format.h>

#include <algorithm>

#include "structure/lammps/effect.h"
#include "structure/lammps/names.h"

namespace magfsi::structure {

namespace {

// Nodes held along all axes belong to the clamps.
std::vector<int> rolling_ids(const LammpsInput& input, std::size_t axis) {
    return ids_where(input, [&](const HeldAxes& held) {
        return held[axis] && held != HeldAxes{true, true, true};
    });
}

// Sets the forces along held axes to zero, so that these nodes, at rest there at first,
// stay at rest. LAMMPS calls fixes in the order of the script, so that these come after
// every fix that adds forces; the fluid's force is added earlier in the step, before the
// forces of ghosts are summed.
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
