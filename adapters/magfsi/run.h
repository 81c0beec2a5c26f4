// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi run: checks the scene, starts its participants as one MPI job, names how it
// ended.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "adapters/magfsi/participants.h"

namespace magfsi::launch {

struct RunOptions {
    std::filesystem::path scene;
    std::filesystem::path out;
    std::vector<std::string> overrides;
    Ranks ranks;                     // those that are given
    std::vector<std::string> notes;  // for the head of the log
    std::string restart;             // latest, a file of a checkpoint, or empty
    int halvings = 0;                // of every step, by retries
    bool overwrite = false;          // what an earlier run left in the folder
    std::string command;             // what the user typed
    bool trace = false;              // write trace.json
    bool page = true;                // write report.html, where the scene lets it
    bool record = false;             // write exchange.record
    std::map<std::string, std::filesystem::path> replay;  // side: the record it plays
    std::filesystem::path structure;  // program in the place of bodies
    std::string error;  // tolerance, "3 %": another setting than the scene's may be run
};

// The exit code of the command line. Throws scene::SceneError on bad input.
int run(const RunOptions& options);

// "fluid=runs/swimmer": one side and the run folder, or the record in it, that it plays.
// Throws std::invalid_argument.
std::map<std::string, std::filesystem::path> parse_replay(const std::string& text);

}  // namespace magfsi::launch
