// SPDX-License-Identifier: GPL-2.0-or-later
// The effect of rigid parts: the group of their nodes, and the fix that moves them.
#include <fmt/format.h>

#include <algorithm>

#include "structure/lammps/effects/rigid_parts/fix_rigid.h"
#include "structure/lammps/names.h"
#include "structure/lammps/placement.h"
#include "structure/lattice/rigid_mass.h"

namespace magfsi::structure {
namespace {

bool has_rigid_parts(const LammpsInput& input) {
    return std::ranges::any_of(
        input.bodies, [](const Body& body) { return !body.rigid_parts.empty(); });
}

// Atom IDs of the nodes of rigid parts, of one part of a body or of all.
std::vector<int> rigid_ids(const LammpsInput& input, std::size_t body, int wanted = -1) {
    std::vector<int> ids;
    const std::vector<int> part = rigid_part_of_nodes(input.bodies[body]);
    const int first = first_id(input, body);
    for (std::size_t n = 0; n < part.size(); ++n) {
        if (part[n] >= 0 && (wanted < 0 || part[n] == wanted))
            ids.push_back(first + static_cast<int>(n));
    }
    return ids;
}

void check_rigid_parts(const LammpsInput& input) {
    if (input.quiet)
        refuse("rigid parts on a path of equilibria found; allowed are runs over time");
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const Body& body = input.bodies[b];
        refuse_held_rigid_parts(body, held_axes(body));
        if (!body.rigid_parts.empty() && !input.placements.empty() &&
            input.placements[b].relaxed)
            refuse("body {} has a rigid part and starts relaxed; allowed is one of both",
                   body.name);
    }
}

void add_group(Lines& lines, const LammpsInput& input) {
    std::vector<int> ids;
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const auto more = rigid_ids(input, b);
        ids.insert(ids.end(), more.begin(), more.end());
    }
    lines.push_back(fmt::format("group rigid id {}", id_ranges(ids)));
    if (!has_moved_parts(input.bodies)) return;
    ids.clear();
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const std::vector<RigidPart>& parts = input.bodies[b].rigid_parts;
        for (std::size_t p = 0; p < parts.size(); ++p) {
            if (!is_moved(parts[p])) continue;
            const auto more = rigid_ids(input, b, static_cast<int>(p));
            ids.insert(ids.end(), more.begin(), more.end());
        }
    }
    lines.push_back(fmt::format("group {} id {}", moved_parts_group, id_ranges(ids)));
}

// The fix comes after the drag, whose work on these nodes it does itself.
void add_fix(Lines& lines, const LammpsInput& input) {
    std::string line = "fix rigid rigid magttice/rigid";
    if (input.drag) line += fmt::format(" drag {:.17g}", input.drag->rate_1_s);
    const std::array<int, 2> plane =
        input.field ? input.field->plane : std::array<int, 2>{0, 2};
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const Body& body = input.bodies[b];
        if (body.rigid_parts.empty()) continue;
        const Placement placement =
            input.placements.empty() ? Placement{} : input.placements[b];
        const auto nodes = placed_nodes(body, placement, plane);
        for (std::size_t p = 0; p < body.rigid_parts.size(); ++p) {
            const int number = static_cast<int>(p);
            const RigidMass mass = rigid_mass(body, number, nodes);
            line += words_of_part({{mass.mass_kg, mass.centre_m, mass.inertia_kg_m2,
                                    body.rigid_parts[p].hold},
                                   placement.velocity_m_s.value_or(Vec3{}),
                                   placement.angular_velocity_rad_s.value_or(Vec3{}),
                                   rigid_ids(input, b, number)});
        }
    }
    lines.push_back(line);
}

}  // namespace

extern const Effect rigid_parts_effect{
    .name = "rigid_parts",
    .asked = has_rigid_parts,
    .check = check_rigid_parts,
    .commands = add_group,
    .after_integration = add_fix,
    .group_left_out = "rigid",
    .fix = {"magttice/rigid", make_fix<FixMagtticeRigid>}};

}  // namespace magfsi::structure
