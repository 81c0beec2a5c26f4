// SPDX-License-Identifier: GPL-2.0-or-later
// Checkpoints during a run, and the orderly end of a run that received a signal to stop.
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

// Makes all ranks of both sides end at the same coupled step. The structure decides, or
// the only side of an uncoupled run: a signal that has reached any of its ranks by the
// end of step n ends the run after step n + 1. The fluid receives the decision as one
// number per step; the message has a whole step to arrive, so the fluid does not wait for
// it.
class StopAgreement {
  public:
    // timeout_s: longest wait for the partner's message [s].
    StopAgreement(const World& world, double timeout_s);

    // Returns true if this was the last step because of a signal. To be called at the end
    // of each step by all ranks; collective over each side. last: true if the clock ends
    // the run with this step anyway. Throws what wait_all throws.
    bool reached(std::int64_t step, bool last);

  private:
    bool decide(std::int64_t step, bool last);
    bool receive_decision();

    const World& world_;
    double timeout_s_;
    bool begun_ = false;                  // true once one step has been completed
    bool stopping_ = false;               // true if the run ends after the coming step
    std::array<std::int64_t, 2> note_{};  // step; 1 to stop after the next step
    MPI_Request sending_ = MPI_REQUEST_NULL;
};

// A participant's output "checkpoint": writes the participant's state every so many
// coupled steps, and once more when a signal has asked the run to end.
class Checkpoints : public Output {
  public:
    // Writes the participant's state. Collective over the participant; file is null
    // except on its root.
    using Save = std::function<void(StateWriter* file)>;

    // Requires a plan with a checkpoint. From here on a signal ends the run at the end of
    // a coupled step, after a checkpoint (postpone_stop).
    Checkpoints(Session& session, Save save);

    // Writes a checkpoint if one is due. Its task must come after the other outputs of
    // the step, so that their files are complete when the checkpoint is. Collective.
    void end_step() override;

    // Deletes all checkpoints but the newest complete ones; called when both sides have
    // ended.
    void finish() override;

  private:
    // Writes this participant's file and then deletes old checkpoints. Collective.
    void write();

    Session& session_;
    Save save_;
    std::int64_t every_;
    StopAgreement stop_;
};

}  // namespace magfsi::coupler
