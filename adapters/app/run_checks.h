// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of a run beyond its scene: command-line options, run folder, missing software.
// Each function throws std::invalid_argument with advice.
#pragma once

#include <filesystem>

#include "adapters/app/run.h"
#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"

namespace magfsi::launch {

// The system's Python, which has Debian's packages.
constexpr const char* python = "/usr/bin/python3";

// Requires the Python packages that a scene with `control` needs: mpi4py and magfsi.
void need_controller();
// Refuses the script of `control` if its text cannot run. The script is not run.
void check_controller(const scene::Control& control);

// Refuses bodies that overlap at the start, themselves, each other, obstacles or sides,
// unless the scene allows overlaps or a body starts in a shape that only the run finds.
void check_overlap_at_start(const scene::Scene& scene, const bodies::Solids& solids);

// Checks --structure: it must be given exactly for scenes with coupling.structure: own,
// and be executable.
void check_structure_program(const scene::Scene& scene, const RunOptions& options);

// Refuses a default run folder that is a symbolic link, where the scene's folder is the
// current one: the scene's author, perhaps a stranger, may have placed the link to have
// files elsewhere overwritten.
void check_default_out(const scene::Scene& scene, const std::filesystem::path& out);

}  // namespace magfsi::launch
