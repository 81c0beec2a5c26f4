// SPDX-License-Identifier: GPL-2.0-or-later
// What a run is refused for beside its scene: the command line's options, the run folder,
// what is missing on this machine. Each throws std::invalid_argument with the advice.
#pragma once

#include <filesystem>

#include "adapters/magfsi/run.h"
#include "adapters/scene/scene.h"

namespace magfsi::launch {

constexpr const char* python = "/usr/bin/python3";  // with Debian's packages

// For scenes with control.
void need_controller();

// --record and --replay.
void check_exchange(const scene::Scene& scene, const RunOptions& options,
                    const std::filesystem::path& out);

// --structure.
void check_structure_program(const scene::Scene& scene, const RunOptions& options);

// Where the scene's folder is the present one, its author may have put a link in the
// place of the run folder.
void check_default_out(const scene::Scene& scene, const std::filesystem::path& out);

}  // namespace magfsi::launch
