// The outermost frame of a participant: MPI, signals, and every way to end.
#pragma once

#include <cstdint>
#include <functional>

#include "coupler/participants/arguments.h"
#include "coupler/participants/run_plan.h"

namespace magfsi::coupler {

// What the guard needs to know to write a summary of a run that failed.
struct RunState {
    std::filesystem::path out;
    RunPlan plan;
    std::int64_t step = 0;  // coupled steps that were completed
    double time_s = 0;
    bool started = false;  // the run folder exists and is ours
};

using ParticipantBody = std::function<void(const ParticipantArguments&, RunState&)>;

// Runs body between MPI_Init and MPI_Finalize. On an exception: one message on stderr, a
// summary.json that says how it ended, and MPI_Abort of the whole job with the exit code
// of errors.h, so that no partner waits.
int run_participant(Role role, const std::string& description, int argc, char** argv,
                    const ParticipantBody& body);

}  // namespace magfsi::coupler
