// SPDX-License-Identifier: GPL-2.0-or-later
// The programs that a scene starts, one for its bodies and one for its fluid, and on how
// many MPI ranks.
#pragma once

#include <map>
#include <string>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"

namespace magfsi::launch {

// Entry of a fluid solver in the table of participants.cpp. A new solver adds its entry
// there, its name in the scene, and a folder of its own.
struct FluidProgram {
    // Name of the executable, beside magfsi's own.
    const char* program;
    // Returns why this build cannot run the solver and what to do, or "".
    std::string (*missing)();
    // Text of `magfsi explain` on the fluid. Throws std::invalid_argument on what the
    // solver refuses.
    std::string (*explain)(const scene::Scene& scene, const bodies::Solids& solids,
                           int ranks);
    // Returns the largest number of ranks on which the solver runs the scene.
    int (*most_ranks)(const scene::Scene& scene);
    // True if cost.h predicts time and memory of this solver.
    bool predicted;
};
// Solver of the scene's fluid; the scene must have one.
const FluidProgram& fluid_program(const scene::Scene& scene);

// True if the scene asks for static equilibria by Newton's method.
bool by_newton(const scene::Scene& scene);

// Names of the executables by role, "structure" and "fluid", for those that the scene
// needs. The name is "" for a structure of the user's own, which --structure names.
std::map<std::string, std::string> programs_of(const scene::Scene& scene);

// Number of MPI ranks by role, "structure" and "fluid".
using Ranks = std::map<std::string, int>;

// Reads text such as "structure=1,fluid=2". Throws std::invalid_argument on any other.
Ranks parse_ranks(const std::string& text);

// Writes text such as "structure=1,fluid=2", as --ranks reads it.
std::string to_text(const Ranks& ranks);

// Number of ranks of each participant of the scene: as given, or by default one for the
// structure and as many for the fluid as cores and cells justify. Throws
// std::invalid_argument if a rank number is given for a role that the scene lacks, or one
// beyond what this machine's cores or the bodies' elements can use.
Ranks choose_ranks(const scene::Scene& scene, const bodies::Solids& solids,
                   const Ranks& given);

// Throws std::invalid_argument if the populations of the fluid's cells alone need more
// than this machine's memory.
void check_memory(const scene::Scene& scene, const bodies::Solids& solids);

}  // namespace magfsi::launch
