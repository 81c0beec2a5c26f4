#include <fmt/format.h>

#include "structure/lammps/effect.h"
#include "structure/lammps/effects/prescribed_motion/motion_law.h"
#include "structure/lammps/names.h"
#include "structure/lammps/node_ids.h"

namespace magfsi::structure {

namespace {

std::vector<int> moved_ids(const LammpsInput& input, const PrescribedMotion& motion) {
    std::vector<int> ids = moved_nodes(input.bodies[motion.body], motion);
    const int first = first_id(input, motion.body);
    for (int& id : ids) id += first;
    return ids;
}

// After the drag, which would slow them.
void add_motions(std::vector<std::string>& lines, const LammpsInput& input) {
    for (std::size_t m = 0; m < input.motions.size(); ++m) {
        const std::string group = moved_group(m);
        lines.push_back(fmt::format("group {} id {}", group,
                                    id_ranges(moved_ids(input, input.motions[m]))));
        lines.push_back(fmt::format("fix {0} {0} magttice/motion {1}", group,
                                    motion_words(input.motions[m].course)));
    }
}

}  // namespace

extern const ScriptEffect prescribed_motion_effect{
    .name = "prescribed_motion",
    .asked = [](const LammpsInput& input) { return !input.motions.empty(); },
    .check = [](const LammpsInput& input) { check_motions(input.bodies, input.motions); },
    .after_integration = add_motions};

}  // namespace magfsi::structure
