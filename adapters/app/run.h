// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi run: checks the scene, starts its participants as one MPI job, and reports how
// it ended.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "adapters/app/participants.h"

namespace magfsi::launch {

// Options of the command line. Values that the launcher adds for its jobs are marked.
struct RunOptions {
    // Scene file, or folder with a scene.yaml.
    std::filesystem::path scene;
    // Run folder; "" for runs/NAME.
    std::filesystem::path out;
    std::vector<std::string> overrides;  // --set, as typed
    Ranks ranks;                         // only those given; run() adds the others
    std::vector<std::string> notes;      // lines for the head of the log
    std::string restart;                 // latest, a file of a checkpoint, or empty
    // Number of times that retries have halved every step (set by the launcher).
    int halvings = 0;
    bool overwrite = false;  // drop earlier results
    std::string command;     // the command as typed, for run.json
    bool trace = false;      // write trace.json
    // True to write report.html at the end, unless the scene switches it off.
    bool page = true;
    // Program of the user's own that replaces the bodies (coupling.structure: own).
    std::filesystem::path structure;
    // Tolerance such as "3 %", or "". With one, a cheaper setting than the scene's may be
    // run.
    std::string error;
};

// Runs the scene to its end. Returns the exit code of the command line. Throws
// std::invalid_argument and scene::SceneError on bad input, std::runtime_error if the job
// cannot be started.
int run(RunOptions options);

}  // namespace magfsi::launch
