// All ranks of both sides end at the same coupled step. The structure decides (or the
// only side there is): a signal that has reached any of its ranks by the end of step n
// ends the run after step n + 1, and the fluid learns of it by one number a step, which
// it has no need to wait for.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>

#include "coupler/participants/world.h"

namespace magfsi::coupler {

class StopAgreement {
  public:
    StopAgreement(const World& world, double timeout_s);

    // At the end of each step, by all ranks: whether this is the last one. last: whether
    // the clock says so anyway.
    bool reached(std::int64_t step, bool last);

  private:
    bool decided_by_the_structure(std::int64_t step, bool last);
    bool told_to_the_fluid();

    const World& world_;
    double timeout_s_;
    bool begun_ = false;                  // one step has been completed
    bool stopping_ = false;               // after the coming step
    std::array<std::int64_t, 2> note_{};  // step, whether to stop after the one behind it
    MPI_Request sending_ = MPI_REQUEST_NULL;
};

}  // namespace magfsi::coupler
