// SPDX-License-Identifier: GPL-2.0-or-later
// The two sides of a run, and the controller beside the structure: how they find each
// other and wait.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "coupler/participants/bell.h"
#include "coupler/participants/processes.h"

namespace magfsi::coupler {

enum class Role { structure = 1, fluid = 2, control = 3 };

std::string to_string(Role role);

// The first act of every participant: all world ranks join one split by role, then the
// two sides are joined by an intercommunicator, and the structure and a controller by
// another. After that nobody uses MPI_COMM_WORLD.
class World {
  public:
    // partner_expected: whether the scene has another side; controller_expected: whether
    // this one, the structure, has a controller. Throws PartnerLost when one was not
    // started, or was started although the scene has none, and where the processes of one
    // side are not of one program and one scene.
    World(Role self, bool partner_expected, std::uint64_t scene_hash = 0,
          bool controller_expected = false);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    Role self() const { return self_; }
    Role other() const {
        return self_ == Role::structure ? Role::fluid : Role::structure;
    }
    MPI_Comm local() const { return local_; }
    MPI_Comm partner() const { return partner_; }  // MPI_COMM_NULL without a partner
    MPI_Comm controller() const { return controller_; }  // the structure's; likewise
    const ProcessId& controller_process() const { return controller_process_; }
    int rank() const { return rank_; }
    int size() const { return size_; }
    int partner_size() const { return partner_size_; }
    bool root() const { return rank_ == 0; }
    bool coupled() const { return partner_ != MPI_COMM_NULL; }
    // The side that writes probes.csv, summary.json and the progress.
    bool leads() const { return root() && (self_ == Role::structure || !coupled()); }

    // Starts to send to that rank of the partner, and wakes it up.
    void send(const void* data, int count, MPI_Datatype type, int rank, int tag,
              MPI_Request* request) const;

  private:
    void join_partner(int first, bool expected);
    void join_controller(int first, bool expected);
    void try_bells(const std::vector<ProcessId>& partner);

    Role self_;
    Bell bell_;
    std::vector<ProcessId> partner_processes_;  // by rank
    MPI_Comm local_ = MPI_COMM_NULL;
    MPI_Comm partner_ = MPI_COMM_NULL;
    MPI_Comm controller_ = MPI_COMM_NULL;
    ProcessId controller_process_;
    int rank_ = 0;
    int size_ = 1;
    int partner_size_ = 0;
};

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

// Receives the message of the partner's root.
void receive_from_root(const World& world, void* data, int count, MPI_Datatype type,
                       int tag, double timeout_s, const std::string& what);

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
