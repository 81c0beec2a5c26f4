// SPDX-License-Identifier: GPL-2.0-or-later
// One MPMD job under mpirun, watched: what it prints as errors is passed on without
// mpirun's own banners, and a process that was killed is named.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/magfsi/mpirun.h"

namespace magfsi::launch {

struct JobEnd {
    int exit_code = 0;
    std::string lost;      // "fluid rank 1 was killed by signal 9"; empty if nobody was
    bool crashed = false;  // mpirun itself, maybe when all was done
    bool stopped = false;  // this process was told to end
    bool told = false;     // a participant has said why it ended
};

// What SIGINT and SIGTERM lead to: participants are asked to end in order, with
// checkpoint after writing one, however long that takes, else within some seconds; a
// second signal ends them at once.
enum class OnStop { end, checkpoint };

// Raises a small limit of the stack as far as it may. Throws std::runtime_error where
// that is not far enough.
void need_stack();

// From here on requests to end (SIGINT, SIGTERM, SIGHUP) wait for the job that starts,
// and are passed on to it. run_job calls it, too.
void pass_on_signals();

// Runs it to the end. It ends, too, when this process dies.
JobEnd run_job(const std::vector<Program>& programs, OnStop on_stop);

}  // namespace magfsi::launch
