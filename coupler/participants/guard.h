// SPDX-License-Identifier: GPL-2.0-or-later
// The outermost frame of a participant: command line, MPI, signals, and every way to end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coupler/output/log.h"
#include "coupler/output/run_folder.h"
#include "coupler/output/summary.h"
#include "coupler/participants/run_plan.h"

namespace magfsi::coupler {

// The command line that every participant understands.
struct ParticipantArguments {
    std::filesystem::path scene;
    std::filesystem::path out;  // run folder; default runs/NAME of the scene
    std::vector<std::string> overrides;
    std::vector<std::string> notes;  // for the head of the log
    std::string restart;             // "latest", a file of a checkpoint, or empty
    int halvings = 0;                // of every step, by a retry
    bool overwrite = false;          // results of an earlier run in the folder
    std::string command;             // what the user typed, where a launcher starts this
    bool trace = false;              // when each task began and ended
    bool record = false;             // what both sides send each other, to play it later
    std::filesystem::path replay;    // the record that a replay participant plays
    output::ProgressMode progress = output::ProgressMode::plain;
    bool help = false;
    std::string help_text;
};

// Throws std::invalid_argument naming the option.
ParticipantArguments parse_arguments(int argc, char** argv,
                                     const std::string& description);

// The run folder when none was given.
std::filesystem::path default_out(const std::string& scene_name);

// What the guard needs to know to write a summary of a run that failed.
struct RunState {
    std::filesystem::path out;
    RunPlan plan;
    std::int64_t step = 0;  // coupled steps that were completed
    double time_s = 0;
    bool started = false;                      // the run folder exists and is ours
    std::unique_ptr<output::FolderLock> lock;  // up to the end of this process
};

// What a summary says of it, however it ends.
output::Summary summary_of(const RunState& state);

using ParticipantBody = std::function<void(const ParticipantArguments&, RunState&)>;

// Runs body between MPI_Init and MPI_Finalize. On an exception: one message on stderr, a
// summary.json that says how it ended, and MPI_Abort of the whole job with the exit code
// of errors.h, so that no partner waits.
int run_participant(Role role, const std::string& description, int argc, char** argv,
                    const ParticipantBody& body);

}  // namespace magfsi::coupler
