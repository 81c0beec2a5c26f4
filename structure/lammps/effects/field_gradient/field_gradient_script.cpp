#include <fmt/format.h>

#include "structure/lammps/effect.h"

namespace magfsi::structure {

namespace {

std::string gradient_words(const LammpsInput& input, const Body& body) {
    if (body.magnetization_a_m.empty()) return "";
    std::string out = " gradient";
    for (const Vec3& row : input.gradient->matrix_t_m) {
        for (double entry : row) out += fmt::format(" {:.17g}", entry);
    }
    for (double entry : input.gradient->origin_m) out += fmt::format(" {:.17g}", entry);
    return out;
}

}  // namespace

extern const ScriptEffect field_gradient_effect{
    .name = "field_gradient",
    .asked = [](const LammpsInput& input) { return input.gradient.has_value(); },
    .body_words = gradient_words};

}  // namespace magfsi::structure
