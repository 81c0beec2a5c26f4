// The first act of every participant: all world ranks join one split by role, then the
// two sides are joined by an intercommunicator. After that nobody uses MPI_COMM_WORLD.
#pragma once

#include <mpi.h>

#include <string>

namespace magfsi::coupler {

enum class Role { structure = 1, fluid = 2 };

std::string to_string(Role role);

class World {
  public:
    // partner_expected: whether the scene has another side. Throws PartnerLost when it
    // was not started, or when it was started although the scene has none.
    World(Role self, bool partner_expected);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    Role self() const { return self_; }
    Role other() const {
        return self_ == Role::structure ? Role::fluid : Role::structure;
    }
    MPI_Comm local() const { return local_; }
    MPI_Comm partner() const { return partner_; }  // MPI_COMM_NULL without a partner
    int rank() const { return rank_; }
    int size() const { return size_; }
    int partner_size() const { return partner_size_; }
    bool root() const { return rank_ == 0; }
    bool coupled() const { return partner_ != MPI_COMM_NULL; }
    // The side that writes probes.csv, summary.json and the progress.
    bool leads() const { return root() && (self_ == Role::structure || !coupled()); }

  private:
    Role self_;
    MPI_Comm local_ = MPI_COMM_NULL;
    MPI_Comm partner_ = MPI_COMM_NULL;
    int rank_ = 0;
    int size_ = 1;
    int partner_size_ = 0;
};

}  // namespace magfsi::coupler
