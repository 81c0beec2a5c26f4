// SPDX-License-Identifier: GPL-2.0-or-later
// The two sides of a run and the controller beside the structure: communicators,
// identities and sending.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "coupler/participants/notifier.h"
#include "coupler/participants/processes.h"

namespace magfsi::coupler {

// The part that a process plays in a run; the values are colours of MPI_Comm_split.
enum class Role { structure = 1, fluid = 2, control = 3 };

std::string to_string(Role role);

// The communicators of a run. Making it is the first act of every participant: all world
// ranks take part in one split by role; an intercommunicator then joins the two sides,
// and another one the structure and a controller. After that nobody uses MPI_COMM_WORLD.
class World {
  public:
    // Collective over all processes of the job. partner_expected: the scene has another
    // side; controller_expected: this side, the structure, has a controller. Throws
    // PartnerLost if an expected side was not started, if a side was started that the
    // scene does not have, and if the processes of this side differ in program or scene.
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
    // Communicator with the controller, MPI_COMM_NULL without one or on the fluid.
    MPI_Comm controller() const { return controller_; }
    const ProcessId& controller_process() const { return controller_process_; }
    int rank() const { return rank_; }
    int size() const { return size_; }
    int partner_size() const { return partner_size_; }
    // Number of the job's processes on this machine, this one included.
    int processes_here() const { return processes_here_; }
    bool root() const { return rank_ == 0; }
    bool coupled() const { return partner_ != MPI_COMM_NULL; }
    // True on the process that writes probes.csv, summary.json and the progress: the root
    // of the structure, or of the only side.
    bool leads() const { return root() && (self_ == Role::structure || !coupled()); }

    // Starts to send to a rank of the partner and wakes it up. data must live until the
    // request is complete.
    void send(const void* data, int count, MPI_Datatype type, int rank, int tag,
              MPI_Request* request) const;
    // Receives a message from the partner's root; `what` names it in errors. Throws what
    // wait_all throws.
    void receive_from_root(void* data, int count, MPI_Datatype type, int tag,
                           double timeout_s, const std::string& what) const;

  private:
    // first: world rank of the first process of that role, or -1 if there is none.
    void join_partner(int first, bool expected);
    void join_controller(int first, bool expected);
    // Notifies all of the partner's processes. Returns true if each of them can notify
    // this one. Collective over both sides.
    bool partner_notifies(const std::vector<ProcessId>& partner);

    Role self_;
    Notifier notifier_;
    // The partner's processes by rank; empty if they cannot be notified.
    std::vector<ProcessId> notified_;
    MPI_Comm local_ = MPI_COMM_NULL;
    MPI_Comm partner_ = MPI_COMM_NULL;
    MPI_Comm controller_ = MPI_COMM_NULL;
    ProcessId controller_process_;
    int rank_ = 0;
    int size_ = 1;
    int partner_size_ = 0;
    int processes_here_ = 1;
};

}  // namespace magfsi::coupler
