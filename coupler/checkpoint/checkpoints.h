// SPDX-License-Identifier: GPL-2.0-or-later
// Checkpoints while a run goes on, and the end of a run that was told to stop.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <functional>

#include "coupler/checkpoint/state_file.h"
#include "coupler/participants/session.h"
#include "coupler/participants/world.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

// All ranks of both sides end at the same coupled step. The structure decides (or the
// only side there is): a signal that has reached any of its ranks by the end of step n
// ends the run after step n + 1, and the fluid receives that decision as one number per
// step, which it has no need to wait for.
class StopAgreement {
  public:
    StopAgreement(const World& world, double timeout_s);

    // At the end of each step, by all ranks: whether this is the last one. last: whether
    // the clock says so anyway.
    bool reached(std::int64_t step, bool last);

  private:
    bool decide(std::int64_t step, bool last);
    bool receive_decision();

    const World& world_;
    double timeout_s_;
    bool begun_ = false;                  // one step has been completed
    bool stopping_ = false;               // after the coming step
    std::array<std::int64_t, 2> note_{};  // step, whether to stop after the one behind it
    MPI_Request sending_ = MPI_REQUEST_NULL;
};

// A participant's output "checkpoint": writes its state every so many coupled steps,
// and once more when the run was told to end, which it then does in order.
class Checkpoints : public Output {
  public:
    // Collective over the participant; file is null but on its root.
    using Save = std::function<void(StateWriter* file)>;

    // For scenes with a checkpoint. From here on a signal no longer ends the run at once.
    Checkpoints(Session& session, Save save);

    // After everything else of a step that leaves files.
    void end_step() override;

    // When both sides have ended: takes away the checkpoints beyond those kept.
    void finish() override;

  private:
    void write();

    Session& session_;
    Save save_;
    std::int64_t every_;
    StopAgreement stop_;
};

// This participant's file of the checkpoint that the session goes on from.
StateReader open_restart(const Session& session);

}  // namespace magfsi::coupler
