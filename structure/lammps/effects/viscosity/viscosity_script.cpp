#include <fmt/format.h>

#include <algorithm>

#include "structure/lammps/effect.h"
#include "structure/body.h"

namespace magfsi::structure {

extern const ScriptEffect viscosity_effect{
    .name = "viscosity",
    .asked =
        [](const LammpsInput& input) {
            return std::ranges::any_of(input.bodies, is_viscous);
        },
    // Those of other materials are among their `material` words.
    .body_words = [](const LammpsInput&, const Body& body) -> std::string {
        const double viscosity = body.material.viscosity_pa_s;
        return viscosity == 0 ? "" : fmt::format(" viscosity {:.17g}", viscosity);
    }};

}  // namespace magfsi::structure
