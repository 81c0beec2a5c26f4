// What an effect of effects.inc gives to the scripts that are written: an object of this
// type, called NAME_effect.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "structure/lammps/script.h"

namespace magfsi::structure {

struct ScriptEffect {
    const char* name;
    bool (*asked)(const LammpsInput&);
    // Adds its commands: only called where it is asked for, as are those below.
    void (*commands)(std::vector<std::string>& lines, const LammpsInput&);
    // Pressure over displacement [Pa/m] of what it presses on a body's surface with, for
    // the stable step. Null: nothing.
    double (*surface_spring_pa_m)(const LammpsInput&, const Body&) = nullptr;
    // Nodes come and go near each other, and are looked for within this distance [m] more
    // than they feel. Null: a body's neighbours stay the same.
    double (*neighbor_skin_m)(const LammpsInput&) = nullptr;
};

// Those of this build.
std::span<const ScriptEffect* const> script_effects();

}  // namespace magfsi::structure
