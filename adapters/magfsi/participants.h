// SPDX-License-Identifier: GPL-2.0-or-later
// The programs that a scene starts, one for its bodies and one for its fluid, and on how
// many MPI ranks.
#pragma once

#include <map>
#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

// What the command line needs to know of a fluid solver. The table is in
// participants.cpp: a new solver adds its line there, its name in the scene, and its own
// folder.
struct FluidProgram {
    const char* program;
    std::string (*missing)();  // why this build cannot run it, and what to do; or empty
    // For `magfsi explain`. Throws std::invalid_argument on what the solver refuses.
    std::string (*explain)(const scene::Scene& scene, int ranks);
    bool predicted;  // its time and memory, in cost.h
};
const FluidProgram& fluid_program(const scene::Scene& scene);

bool by_newton(const scene::Scene& scene);

// Names of programs by role: structure, fluid.
std::map<std::string, std::string> programs_of(const scene::Scene& scene);

using Ranks = std::map<std::string, int>;  // by role: structure, fluid

// "structure=1,fluid=2". Throws std::invalid_argument.
Ranks parse_ranks(const std::string& text);

// "structure=1,fluid=2", as --ranks takes it.
std::string to_text(const Ranks& ranks);

// Of each participant that the scene has: as given, or what the cores and the number of
// cells make of it. Throws std::invalid_argument if one is given that the scene lacks, or
// a number beyond what the machine's cores or the bodies' elements can use.
Ranks choose_ranks(const scene::Scene& scene, const Ranks& given);

// Throws std::invalid_argument where the fluid's cells take more than this machine's
// memory.
void check_memory(const scene::Scene& scene);

}  // namespace magfsi::launch
