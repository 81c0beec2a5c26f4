// SPDX-License-Identifier: GPL-2.0-or-later
// The main function of a participant that runs a scene.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "adapters/scene/scene.h"
#include "coupler/participants/guard.h"
#include "coupler/participants/session.h"

namespace magfsi {

// Collects what the coupler needs to know of a scene: roles, end time, densities, hashes,
// effects, warnings. The coupler itself does not know the scene.
// goes_on: from a checkpoint.
coupler::RunPlan run_plan(const scene::Scene& scene, bool goes_on = false);

// Model name of the processor as in /proc/cpuinfo.
std::string processor();
// Number of cores that this process may use (its affinity mask).
int available_cores();
// Number of ranks or threads at which each still has enough cells to be worth its
// messages (fitted::cells_worth_a_rank).
int worthwhile_parts(const scene::Fluid& fluid);

// True if a run with this --restart continues in the folder of its checkpoint, whose
// results must then stay.
bool goes_on_in(const std::filesystem::path& out, const std::string& restart);
// Throws std::invalid_argument if a run to the folder `out` would move its own scene
// aside, with the results that lie there.
void refuse_own_scene(const std::filesystem::path& scene_file,
                      const std::filesystem::path& out, const std::string& restart);

// Solver part of a participant: must call session.begin with the coupled step, then run
// all steps. Scene and session outlive the call.
using RunScene = std::function<void(const scene::Scene&, coupler::Session&,
                                    const coupler::ParticipantArguments&)>;

// Throws std::invalid_argument if the scene has no fluid, or one of another solver.
void require_solver(const scene::Scene& scene, scene::FluidSolver solver);

// Main function of a participant: reads the arguments and the scene, joins the MPI job,
// makes the session and calls `run`. Collective over all ranks of the job. Returns the
// exit code.
int run_scene(coupler::Role role, const std::string& description, int argc, char** argv,
              const RunScene& run);

}  // namespace magfsi
