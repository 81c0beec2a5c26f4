// SPDX-License-Identifier: GPL-2.0-or-later
// One MPMD job under mpirun, watched: what it prints as errors is passed on without
// mpirun's own banners, and a process that was killed is named.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/app/mpirun.h"

namespace magfsi::launch {

// End of a job: exit code and cause.
struct JobEnd {
    // Exit code of mpirun; 128 + signal if a signal killed mpirun.
    int exit_code = 0;
    // Name and signal of a killed process, such as "fluid rank 1 was killed by signal 9
    // (Killed)"; empty if none was killed.
    std::string lost;
    // True if mpirun itself crashed, possibly after all participants had ended well.
    bool crashed = false;
    // True if this process was asked to end by a signal.
    bool stopped = false;
    // True if a participant has printed an error message.
    bool told = false;
};

// Response to SIGINT and SIGTERM. Participants are asked to end in order; with
// `checkpoint` they first write one, however long that takes, with `end` they are killed
// after some seconds. A second signal kills them at once.
enum class OnStop { end, checkpoint };

// Raises the stack limit of this process towards 8 MiB. Throws std::runtime_error if the
// hard limit is below 1 MiB.
void need_stack();

// Installs the handlers of SIGINT, SIGTERM and SIGHUP. A request that comes before a job
// runs is kept for the job that starts next. run_job calls this function, too.
void pass_on_signals();

// Runs the programs as one MPMD job and waits for its end. Errors of the participants go
// to stderr, each line that begins with "magfsi" once. The job ends when this process
// dies. Throws std::runtime_error if no process can be started.
JobEnd run_job(const std::vector<Program>& programs, OnStop on_stop);

}  // namespace magfsi::launch
