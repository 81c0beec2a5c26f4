#include <fmt/format.h>

#include "structure/lammps/effect.h"

namespace magfsi::structure {

extern const ScriptEffect drag_effect{
    .name = "drag",
    .asked = [](const LammpsInput& input) { return input.drag_rate_1_s.has_value(); },
    .commands =
        [](std::vector<std::string>& lines, const LammpsInput& input) {
            lines.push_back(
                fmt::format("fix drag all magttice/drag {:.17g}", *input.drag_rate_1_s));
        }};

}  // namespace magfsi::structure
