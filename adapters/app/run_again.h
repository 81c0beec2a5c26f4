// SPDX-License-Identifier: GPL-2.0-or-later
// A run folder as the scene of another run (its scene.yaml has the overrides, its
// scene_files/ what it reads), and the choice of the folder that a run writes to.
#pragma once

#include <filesystem>

#include "adapters/app/participants.h"
#include "adapters/app/run.h"
#include "adapters/scene/scene.h"

namespace magfsi::launch {

// Ranks of the last start in a run folder, on which the bytes of its results depend;
// empty if the path is none. Those of participants that the scene lacks are left out.
Ranks ranks_of_run(const scene::Scene& scene, const std::filesystem::path& path);

// The folder that the options ask for; else that of the run that goes on, runs/NAME, or
// runs/NAME-again where that is the scene's own. Throws std::invalid_argument.
std::filesystem::path run_folder(const scene::Scene& scene, const RunOptions& options);

}  // namespace magfsi::launch
