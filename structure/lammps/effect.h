// What an effect of effects.inc gives to the scripts that are written: an object of this
// type, called NAME_effect.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "structure/lammps/script.h"

namespace magfsi::structure {

// All but the first two are only called where the effect is asked for. Null: nothing.
struct ScriptEffect {
    using Commands = void (*)(std::vector<std::string>& lines, const LammpsInput&);

    const char* name;
    bool (*asked)(const LammpsInput&);
    // Throws std::invalid_argument on what it cannot do.
    void (*check)(const LammpsInput&) = nullptr;

    // Its commands, in the order of the script:
    Commands before_bodies = nullptr;
    // A keyword of the body's fix magttice and its values (body_force.h).
    std::string (*body_words)(const LammpsInput&, const Body&) = nullptr;
    Commands commands = nullptr;  // after the bodies, before what integrates
    Commands after_integration = nullptr;

    // The group that is integrated in place of all atoms.
    const char* integrated_group = nullptr;
    // Pressure over displacement [Pa/m] of what it presses on a body's surface with, for
    // the stable step.
    double (*surface_spring_pa_m)(const LammpsInput&, const Body&) = nullptr;
    // Nodes come and go near each other, and are looked for within this distance [m] more
    // than they feel. Null: a body's neighbours stay the same.
    double (*neighbor_skin_m)(const LammpsInput&) = nullptr;
};

// Those of this build.
std::span<const ScriptEffect* const> script_effects();
// Of these, in their order, those that are asked for.
std::vector<const ScriptEffect*> asked_effects(const LammpsInput& input);

}  // namespace magfsi::structure
