#include <fmt/format.h>

#include "structure/lammps/effect.h"

namespace magfsi::structure {

namespace {

// Variables, so that a script can put its own course in their place.
void add_field(std::vector<std::string>& lines, const LammpsInput& input) {
    lines.push_back(
        fmt::format("fix field all magttice/field {}", field_arguments(*input.field)));
    for (int d = 0; d < 3; ++d) {
        lines.push_back(fmt::format("variable B{} equal f_field[{}]", "xyz"[d], d + 1));
    }
}

}  // namespace

extern const ScriptEffect magnetic_field_effect{
    .name = "magnetic_field",
    .asked = [](const LammpsInput& input) { return input.field.has_value(); },
    .before_bodies = add_field,
    .body_words = [](const LammpsInput&, const Body& body) -> std::string {
        return body.magnetization_a_m.empty() ? "" : " field v_Bx v_By v_Bz";
    }};

}  // namespace magfsi::structure
