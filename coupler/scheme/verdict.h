// In an implicit scheme the structure decides whether a step is repeated; the fluid is
// told.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>

#include "coupler/exchange/message.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

// The structure's end; only its root sends.
class VerdictSender {
  public:
    VerdictSender(const World& world, double timeout_s);
    ~VerdictSender();
    VerdictSender(const VerdictSender&) = delete;
    VerdictSender& operator=(const VerdictSender&) = delete;

    void send(const Occasion& when, bool again);

  private:
    const World& world_;
    double timeout_s_;
    std::array<std::int64_t, 3> note_{};  // step, iteration, again
    MPI_Request sending_ = MPI_REQUEST_NULL;
};

// The fluid's: whether the step is repeated. Collective over the fluid. Throws
// PartnerLost when the verdict is of another step or iteration.
bool receive_verdict(const World& world, const Occasion& when, double timeout_s);

}  // namespace magfsi::coupler
