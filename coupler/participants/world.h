// SPDX-License-Identifier: GPL-2.0-or-later
// The two sides of a run, and the controller beside the structure: how they find each
// other and send.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "coupler/participants/notifier.h"
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
    // Number of the job's processes on this machine, this one included.
    int processes_here() const { return processes_here_; }
    bool root() const { return rank_ == 0; }
    bool coupled() const { return partner_ != MPI_COMM_NULL; }
    // The side that writes probes.csv, summary.json and the progress.
    bool leads() const { return root() && (self_ == Role::structure || !coupled()); }

    // Starts to send to that rank of the partner, and wakes it up.
    void send(const void* data, int count, MPI_Datatype type, int rank, int tag,
              MPI_Request* request) const;
    // Receives the message of the partner's root; throws what wait_all throws.
    void receive_from_root(void* data, int count, MPI_Datatype type, int tag,
                           double timeout_s, const std::string& what) const;

  private:
    void join_partner(int first, bool expected);
    void join_controller(int first, bool expected);
    // Whether each of the partner's processes can notify this one.
    bool partner_notifies(const std::vector<ProcessId>& partner);

    Role self_;
    Notifier notifier_;
    std::vector<ProcessId> notified_;  // the partner's, by rank; empty: they cannot be
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
