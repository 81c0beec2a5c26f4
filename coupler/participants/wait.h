// Waiting for the partner without burning the core it may need, and without hanging.
#pragma once

#include <mpi.h>

#include <span>
#include <string>

namespace magfsi::coupler {

// Start-up (reading, relaxing the shape) may take far longer than a step.
constexpr double startup_timeout_s = 900;

// Completes all requests. Spins for a moment, then sleeps between looks, the longer the
// more it has waited. Throws
// PartnerLost after timeout_s (its text names `what`), and Stopped when the process was
// told to end.
void wait_all(std::span<MPI_Request> requests, double timeout_s, const std::string& what);

// Waits until a message from each of the ranks can be received. A long message takes some
// turns of both sides; a receive that is posted after this waits for those without the
// long naps of a wait for the partner's whole step.
void wait_for_messages(MPI_Comm comm, std::span<const int> ranks, int tag,
                       double timeout_s, const std::string& what);

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
