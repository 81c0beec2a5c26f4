// SPDX-License-Identifier: GPL-2.0-or-later
// Waiting for other processes without taking the core that they may need, and signals
// that end a wait.
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

// The processes that the waits of this process, which are free functions, are for. World
// sets them.
struct Awaited {
    struct Process {
        ProcessId id;
        std::string name;
    };
    std::vector<Process> processes{};
    std::string partner = "partner";  // name of the partner in messages
    // Notifier of this process, if all of the partner's processes notify it; else null.
    const Notifier* notifier = nullptr;
};
void set_awaited(Awaited of_this_process);

// Infinite time limit, for waits at start-up (reading, relaxing the shape) and for all
// waits if the user sets no limit.
constexpr double no_timeout_s = std::numeric_limits<double>::infinity();

// Completes all requests: polls for a moment, then sleeps between polls, the longer the
// more it has waited. A partner that lives is waited for, also while it is suspended,
// with a message each minute. Throws PartnerLost if the partner is gone, TimedOut after
// timeout_s [s] of this process's own running time (the text names `what`), and Stopped
// if the process was told to end.
void wait_all(std::span<MPI_Request> requests, double timeout_s, const std::string& what);

// Waits until a message from each of the ranks can be received; sleeps until it comes if
// World::send sends it. Throws what wait_all throws. A long message takes some exchanges
// of both sides: the receive that is posted after this wait needs only short naps for
// them, not those of a wait for the partner's whole step. whom: name of the sender in
// messages, by default the partner.
void wait_for_messages(MPI_Comm comm, std::span<const int> ranks, int tag,
                       double timeout_s, const std::string& what,
                       const std::string& whom = {});

// Sets the receiver of the message that a long wait gives each minute.
void tell_of_long_waits(std::function<void(const std::string&)> tell);

// Time [s] that this process has spent in these waits since its start.
double waited_s();

// Makes SIGTERM, SIGINT and SIGUSR1 set a flag, which waits and the step loop look at.
// Ignores SIGXFSZ, so that a file beyond its size limit is a failed write.
void catch_stop_signals();
int stop_requested();  // the signal's number, 0 if none

// Lets the step loop answer a signal at the end of a coupled step, while waits go on:
// after SIGUSR1, which the launcher sends for this purpose, up to their time limit; after
// SIGTERM for a moment only, since mpirun sends it also when a partner is gone.
void postpone_stop();
bool stop_postponed();

}  // namespace magfsi::coupler
