// Each node is tied by a spring to where it starts: LAMMPS's own fix spring/self, on all
// nodes. An elastic bed, or a gentle hand.
#include <fmt/format.h>

#include "structure/lammps/effect.h"
#include "structure/lammps/effects/tether/tether.h"

namespace magfsi::structure {

extern const ScriptEffect tether_effect{
    .name = "tether",
    .asked = [](const LammpsInput&) { return tether_n_m.has_value(); },
    .commands = [](std::vector<std::string>& lines, const LammpsInput&) {
        lines.push_back(fmt::format("fix tether all spring/self {:.17g}", *tether_n_m));
    }};

}  // namespace magfsi::structure
