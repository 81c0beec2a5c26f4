// SPDX-License-Identifier: GPL-2.0-or-later
// Clamps. The nodes are left out of the time integration: they cannot move, and the force
// on them stays readable as the reaction. Every node that is held along all three axes
// counts as clamped, also if rollers hold it.
#include <fmt/format.h>

#include "structure/lammps/effect.h"
#include "structure/lammps/names.h"

namespace magfsi::structure {

namespace {

std::vector<int> clamped_ids(const LammpsInput& input) {
    return ids_where(input, [](const HeldAxes& held) {
        return held == HeldAxes{true, true, true};
    });
}

void add_clamps(Lines& lines, const LammpsInput& input) {
    lines.push_back(fmt::format("group clamped id {}", id_ranges(clamped_ids(input))));
}

}  // namespace

extern const Effect clamps_effect{
    .name = "clamps",
    .asked = [](const LammpsInput& input) { return !clamped_ids(input).empty(); },
    .commands = add_clamps,
    .group_left_out = "clamped"};

}  // namespace magfsi::structure
