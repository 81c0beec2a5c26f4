// SPDX-License-Identifier: GPL-2.0-or-later
// How a process waits for others without taking the core that they may need, and how it
// is told to end meanwhile.
#pragma once

#include <mpi.h>

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "coupler/participants/notifier.h"
#include "coupler/participants/processes.h"

namespace magfsi::coupler {

// Whom the waits of this process, which are free functions, are for: World says so.
struct Awaited {
    struct Process {
        ProcessId id;
        std::string name;
    };
    std::vector<Process> processes{};
    std::string partner = "partner";     // its name
    const Notifier* notifier = nullptr;  // of this process, if all of the partner use it
};
void set_awaited(Awaited of_this_process);

// Of start-up (reading, relaxing the shape), and of all waits where the user sets none.
constexpr double no_timeout_s = std::numeric_limits<double>::infinity();

// Completes all requests without taking the core that the partner may need: polls for a
// moment, then sleeps in between, the longer the more it has waited. A partner that lives
// is waited for, also while it is suspended, with a word about it each minute. Throws
// PartnerLost when it is gone, TimedOut after timeout_s of this process's own running
// time (its text names `what`); Stopped when the process was told to end.
void wait_all(std::span<MPI_Request> requests, double timeout_s, const std::string& what);

// Waits until a message from each of the ranks can be received, asleep until it comes if
// World::send sends it. A long message takes some turns of both sides; a receive that is
// posted after this waits for those without the long naps of a wait for the partner's
// whole step.
// whom: for the word about it; without it, the partner.
void wait_for_messages(MPI_Comm comm, std::span<const int> ranks, int tag,
                       double timeout_s, const std::string& what,
                       const std::string& whom = {});

// Who hears, each minute, what this process waits for.
void tell_of_long_waits(std::function<void(const std::string&)> tell);

// Seconds that this process has spent in these waits so far.
double waited_s();

// From now on SIGTERM, SIGINT and SIGUSR1 set a flag that stop_requested reports; waits
// and the step loop look at it.
void catch_stop_signals();
int stop_requested();  // the signal's number, 0 if none

// From now on the step loop answers a signal, at the end of a coupled step, and waits go
// on: after SIGUSR1, which the launcher sends for this, up to their timeout; after
// SIGTERM for a moment only, since mpirun sends it too when a partner is gone.
void postpone_stop();
bool stop_postponed();

}  // namespace magfsi::coupler
