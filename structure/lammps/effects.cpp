#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "structure/body.h"
#include "structure/lammps/effect.h"

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

void refuse_absent(const LammpsInput& input) {
    const auto need = [](bool asked, const char* name) {
        const auto is_it = [&](const ScriptEffect* e) {
            return std::string(e->name) == name;
        };
        if (!asked || std::ranges::any_of(script_effects(), is_it)) return;
        throw std::invalid_argument(
            fmt::format("{} is asked for, and this program was built without it", name));
    };
    need(input.field.has_value(), "magnetic_field");
    need(input.gradient.has_value(), "field_gradient");
    need(input.contact.has_value(), "contact");
    need(input.gravity_m_s2.has_value(), "gravity");
    need(input.drag_rate_1_s.has_value(), "drag");
    need(input.platform.has_value(), "platform");
    need(!input.motions.empty(), "prescribed_motion");
    for (const Body& body : input.bodies) {
        need(is_viscous(body), "viscosity");
        need(std::ranges::count(held_axes(body), HeldAxes{true, true, true}) > 0,
             "clamps");
        need(!body.rollers.empty(), "rollers");
    }
}

}  // namespace

std::span<const ScriptEffect* const> script_effects() {
    return std::span(registered).first(std::size(registered) - 1);
}

std::vector<const ScriptEffect*> asked_effects(const LammpsInput& input) {
    std::vector<const ScriptEffect*> asked;
    for (const ScriptEffect* effect : script_effects()) {
        if (effect->asked(input)) asked.push_back(effect);
    }
    return asked;
}

void check_effects(const LammpsInput& input) {
    refuse_absent(input);
    for (const ScriptEffect* effect : asked_effects(input)) {
        if (effect->check) effect->check(input);
    }
}

double surface_spring_pa_m(const LammpsInput& input, const Body& body) {
    double sum = 0;
    for (const ScriptEffect* effect : asked_effects(input)) {
        if (effect->surface_spring_pa_m) sum += effect->surface_spring_pa_m(input, body);
    }
    return sum;
}

}  // namespace magfsi::structure
