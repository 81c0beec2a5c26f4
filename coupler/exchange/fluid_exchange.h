// The fluid rank's end of the marker exchange.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "coupler/exchange/message.h"
#include "coupler/immersed_boundary/grid.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

// The markers that may touch this rank's cells, those of structure rank 0 first.
struct MarkerBatch {
    std::vector<Vec3> before_m;  // where the impulse acts
    std::vector<Vec3> impulse;   // given to the fluid [N s]
    std::vector<Vec3> now_m;     // where to sample next
};

class FluidExchange {
  public:
    FluidExchange(const World& world, double timeout_s);

    // Waits until the last velocities are taken: MPI reads them from here. Not when an
    // exception ends the run, which the partner may have left already: then they are
    // kept.
    ~FluidExchange();
    FluidExchange(const FluidExchange&) = delete;
    FluidExchange& operator=(const FluidExchange&) = delete;

    // The structure's message of a coupled step; -1 is the one before step 0.
    const MarkerBatch& receive(const Occasion& when);

    // A further message of the same step, of the same markers.
    const MarkerBatch& receive_more(const Occasion& when);

    // This rank's share of the velocities [m/s] at the batch's `now` positions.
    void send(const Occasion& when, std::span<const Vec3> velocity);

    // Waits until the structure has them. A message too long for MPI's buffers moves only
    // while both sides are inside MPI: without this the structure may wait for a whole
    // step of a fluid that goes on to work.
    void finish_sending();

  private:
    void renew(std::int64_t step);
    void unpack(const Occasion& when);

    const World& world_;
    double timeout_s_;
    std::vector<int> count_;    // markers by structure rank
    std::vector<int> senders_;  // structure ranks that have any
    std::vector<std::vector<double>> in_, out_;
    std::vector<MPI_Request> sending_;
    MarkerBatch batch_;
};

}  // namespace magfsi::coupler
