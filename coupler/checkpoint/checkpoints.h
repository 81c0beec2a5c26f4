// A participant's output "checkpoint": writes its state every so many coupled steps,
// and once more when the run was told to end, which it then does in order.
#pragma once

#include <cstdint>
#include <functional>

#include "coupler/checkpoint/state_writer.h"
#include "coupler/checkpoint/stop_agreement.h"
#include "coupler/participants/session.h"
#include "coupler/step/outputs.h"

namespace magfsi::coupler {

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

}  // namespace magfsi::coupler
