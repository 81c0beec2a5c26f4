// Each node is tied by a spring to where it starts: LAMMPS's own fix spring/self, on all
// nodes, "tether" N/m each. An elastic bed, or a gentle hand.
#include <fmt/format.h>

#include "structure/lammps/effect.h"

namespace magfsi::structure {

extern const ScriptEffect tether_effect{
    "tether", [](const LammpsInput& input) { return input.others.contains("tether"); },
    [](std::vector<std::string>& lines, const LammpsInput& input) {
        lines.push_back(
            fmt::format("fix tether all spring/self {:.17g}", input.others.at("tether")));
    }};

}  // namespace magfsi::structure
