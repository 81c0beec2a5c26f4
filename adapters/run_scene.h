// SPDX-License-Identifier: GPL-2.0-or-later
// The main function of a participant that runs a scene.
#pragma once

#include <functional>
#include <string>

#include "adapters/scene/scene.h"
#include "coupler/participants/guard.h"
#include "coupler/participants/session.h"

namespace magfsi {

// What the coupler has to know of a scene.
coupler::RunPlan run_plan(const scene::Scene& scene);

std::string processor();  // in words
int available_cores();    // to this process
// Number of ranks or threads of a fluid that have enough cells to be worth their
// messages.
int worthwhile_parts(const scene::Fluid& fluid);

// Begins the session with its coupled step and runs. scene and session outlive the call.
using RunScene = std::function<void(const scene::Scene&, coupler::Session&,
                                    const coupler::ParticipantArguments&)>;

// Throws std::invalid_argument where the scene's fluid is another solver's, or none.
void require_solver(const scene::Scene& scene, scene::FluidSolver solver);

// coupler::run_participant with the scene of the arguments, read, and its session.
// Returns the exit code.
int run_scene(coupler::Role role, const std::string& description, int argc, char** argv,
              const RunScene& run);

}  // namespace magfsi
