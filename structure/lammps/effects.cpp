// SPDX-License-Identifier: GPL-2.0-or-later
// List of the effects of this build, and the functions that go through all of them.
#include "structure/lammps/effect.h"
#include "structure/refuse.h"

#include "atom.h"
#include "error.h"
#include "utils.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "structure/body.h"
#include "structure/lammps/fix_magttice.h"
#include "structure/lammps/register_styles.h"

namespace magfsi::structure {

#define MAGFSI_EFFECT(name) extern const Effect name##_effect;
#include "structure/lammps/effects.inc"
#undef MAGFSI_EFFECT

namespace {

#define MAGFSI_EFFECT(name) &name##_effect,
constexpr const Effect* registered[] = {
#include "structure/lammps/effects.inc"
    nullptr};
#undef MAGFSI_EFFECT

// Throws std::invalid_argument if the input asks for an effect whose file is not in this
// build.
void refuse_absent(const LammpsInput& input) {
    const auto need = [](bool asked, std::string_view name) {
        const auto is_it = [&](const Effect* e) { return e->name == name; };
        if (!asked || std::ranges::any_of(effects(), is_it)) return;
        refuse(
            "{} is asked for, and this program was built without it; leave its key out, "
            "or build the program with it",
            name);
    };
    need(input.field.has_value(), "magnetic_field");
    need(input.gradient.has_value(), "field_gradient");
    need(!input.sources.empty(), "field_sources");
    need(input.dipoles.has_value(), "dipoles");
    need(input.contact.has_value(), "contact");
    need(input.gravity_m_s2.has_value(), "gravity");
    need(input.drag.has_value(), "drag");
    need(input.platform.has_value(), "platform");
    need(!input.walls.empty(), "walls");
    need(input.contact_load, "contact_load");
    need(!input.motions.empty(), "prescribed_motion");
    for (const Body& body : input.bodies) {
        need(is_viscous(body), "viscosity");
        need(std::ranges::count(held_axes(body), HeldAxes{true, true, true}) > 0,
             "clamps");
        need(!body.rollers.empty(), "rollers");
        need(!body.rigid_parts.empty(), "rigid_parts");
    }
}

// The handler of set_failure_handler, one for the process.
std::function<void(const std::string&)>& failure_handler() {
    static std::function<void(const std::string&)> handler;
    return handler;
}

std::string& advice() {
    static std::string words;
    return words;
}

}  // namespace

// The array ends with a null, which keeps it valid for an empty list and is left out
// here.
std::span<const Effect* const> effects() {
    return std::span(registered).first(std::size(registered) - 1);
}

std::vector<const Effect*> asked_effects(const LammpsInput& input) {
    std::vector<const Effect*> asked;
    std::ranges::copy_if(effects(), std::back_inserter(asked),
                         [&](const Effect* effect) { return effect->asked(input); });
    return asked;
}

void check_effects(const LammpsInput& input) {
    refuse_absent(input);
    for (const Effect* effect : asked_effects(input)) {
        if (effect->check) effect->check(input);
    }
}

std::string integrated_group(const LammpsInput& input) {
    for (const Effect* effect : asked_effects(input)) {
        if (effect->group_left_out) return "moving";
    }
    return "all";
}

double surface_spring_pa_m(const LammpsInput& input, const Body& body) {
    double sum = 0;
    for (const Effect* effect : asked_effects(input)) {
        if (effect->surface_spring_pa_m) sum += effect->surface_spring_pa_m(input, body);
    }
    return sum;
}

void register_styles(LAMMPS_NS::LAMMPS& lammps) {
    auto& fixes = *lammps.modify->fix_map;
    fixes["magttice"] = make_fix<FixMagttice>;
    for (const Effect* effect : effects()) {
        if (effect->fix.name) fixes[effect->fix.name] = effect->fix.make;
        if (effect->register_styles) effect->register_styles(lammps);
    }
}

void set_failure_handler(std::function<void(const std::string& cause)> handler,
                         const std::string& advice_words) {
    failure_handler() = std::move(handler);
    advice() = advice_words;
}

const std::string& advice_if_unstable() {
    static const std::string of_a_script =
        "take a smaller time step, a finer mesh or weaker loads";
    return advice().empty() ? of_a_script : advice();
}

void fail(LAMMPS_NS::Error& error, const std::string& cause) {
    if (failure_handler()) {
        failure_handler()(cause);
        std::abort();  // the handler's contract is not to return
    }
    error.one(FLERR, cause);
}

double number(const char* word, LAMMPS_NS::LAMMPS* lammps) {
    return LAMMPS_NS::utils::numeric(FLERR, word, false, lammps);
}

OwnedElements soft_ones(const OwnedElements& owned, const Lattice& lattice) {
    if (lattice.element_rigid.empty()) return owned;
    OwnedElements soft;
    for (std::size_t i = 0; i < owned.element.size(); ++i) {
        if (lattice.element_rigid[owned.element[i]] >= 0) continue;
        soft.element.push_back(owned.element[i]);
        soft.atom.push_back(owned.atom[i]);
    }
    return soft;
}

void refuse_integrated_twice(LAMMPS_NS::LAMMPS& lammps, const LAMMPS_NS::Fix& self) {
    const LAMMPS_NS::Atom& atom = *lammps.atom;
    for (int f = 0; f < lammps.modify->nfix; ++f) {
        const LAMMPS_NS::Fix& other = *lammps.modify->fix[f];
        if (other.time_integrate == 0 || &other == &self) continue;
        for (int i = 0; i < atom.nlocal; ++i) {
            if ((atom.mask[i] & self.groupbit) != 0 &&
                (atom.mask[i] & other.groupbit) != 0)
                fail(*lammps.error,
                     "fix {} {} and fix {} {} both move atom {}; leave the atoms of the "
                     "first out of the other's group",
                     self.id, self.style, other.id, other.style, atom.tag[i]);
        }
    }
}

}  // namespace magfsi::structure
