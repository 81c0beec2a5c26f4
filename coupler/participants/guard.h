// SPDX-License-Identifier: GPL-2.0-or-later
// The outermost frame of a participant: command line, MPI, signals, and every way in
// which the run can end.
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

// The command line that all participants understand.
struct ParticipantArguments {
    std::filesystem::path scene;
    std::filesystem::path out;  // run folder; default runs/NAME of the scene
    // Values of keys that replace those of the scene file, as "path.to.key=value".
    std::vector<std::string> overrides;
    std::vector<std::string> notes;  // lines for the head of the log
    std::string restart;             // "latest", a checkpoint's file, or empty
    int halvings = 0;                // number of times that a retry halves all steps
    bool overwrite = false;          // drop results of an earlier run in the folder
    std::string command;             // command line of the launcher, if there is one
    bool trace = false;              // write when each task began and ended
    output::ProgressMode progress = output::ProgressMode::plain;
    bool help = false;  // the help text was asked for
    std::string help_text;
};

// Parses the command line. The launcher's own command comes from the environment variable
// MAGFSI_COMMAND. Throws std::invalid_argument that names the option.
ParticipantArguments parse_arguments(int argc, char** argv,
                                     const std::string& description);

// The run folder if none is given: runs/NAME.
std::filesystem::path default_out(const std::string& scene_name);

// The state of a run as the guard needs it to write a summary if the run fails. The
// session keeps it up to date.
struct RunState {
    std::filesystem::path out;
    RunPlan plan;
    std::int64_t step = 0;  // coupled steps completed
    double time_s = 0;      // time at their end
    bool started = false;   // the run folder exists and belongs to this run
    std::unique_ptr<output::FolderLock> lock;  // held until the process ends
};

// The parts of a summary that are known however the run ends.
output::Summary summary_of(const RunState& state);

// The run itself, between MPI_Init and MPI_Finalize. It fills the state.
using ParticipantBody = std::function<void(const ParticipantArguments&, RunState&)>;

// Runs body between MPI_Init and MPI_Finalize and returns the exit code. On an exception
// it prints one message on stderr, writes a summary.json with the cause, and ends the
// whole job by MPI_Abort with the exit code of errors.h, so that no partner waits.
int run_participant(Role role, const std::string& description, int argc, char** argv,
                    const ParticipantBody& body);

}  // namespace magfsi::coupler
