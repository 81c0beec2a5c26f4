#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "structure/lammps/effect.h"
#include "structure/lammps/script_lines.h"

namespace magfsi::structure {

#define MAGFSI_EFFECT(name) extern const ScriptEffect name##_effect;
#include "structure/lammps/effects.inc"
#undef MAGFSI_EFFECT

namespace {

#define MAGFSI_EFFECT(name) &name##_effect,
constexpr const ScriptEffect* registered[] = {
#include "structure/lammps/effects.inc"
    nullptr};
#undef MAGFSI_EFFECT

}  // namespace

std::span<const ScriptEffect* const> script_effects() {
    return std::span(registered).first(std::size(registered) - 1);
}

double surface_spring_pa_m(const LammpsInput& input, const Body& body) {
    double sum = 0;
    for (const ScriptEffect* effect : script_effects()) {
        if (effect->surface_spring_pa_m && effect->asked(input))
            sum += effect->surface_spring_pa_m(input, body);
    }
    return sum;
}

void add_effects(Lines& lines, const LammpsInput& input) {
    for (const ScriptEffect* effect : script_effects()) {
        if (effect->asked(input)) effect->commands(lines, input);
    }
}

void check_effects(const LammpsInput& input) {
    const auto check = [](bool asked, const char* name) {
        const auto is_it = [&](const ScriptEffect* e) {
            return std::string(e->name) == name;
        };
        if (!asked || std::ranges::any_of(script_effects(), is_it)) return;
        throw std::invalid_argument(
            fmt::format("{} is asked for, and this program was built without it", name));
    };
    check(input.contact.has_value(), "contact");
    check(input.gravity_m_s2.has_value(), "gravity");
    check(input.drag_rate_1_s.has_value(), "drag");
    check(input.platform.has_value(), "platform");
}

}  // namespace magfsi::structure
