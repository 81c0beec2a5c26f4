// SPDX-License-Identifier: GPL-2.0-or-later
// A fluid as a participant, whatever solves it: its coupled step, assembled from the
// scene.
#pragma once

#include <memory>

#include "adapters/fluids/fluid_run.h"
#include "coupler/output/log.h"
#include "coupler/participants/session.h"
#include "coupler/scheme/fluid_coupling.h"
#include "coupler/step/report.h"
#include "coupler/step/task_list.h"

namespace magfsi::fluids {

class Participant {
  public:
    // fluid: at the session's step and state; both outlive this.
    Participant(const scene::Scene& scene, coupler::Session& session, FluidSolver& fluid,
                output::ProgressMode progress);
    void run();

  private:
    void restore(const coupler::StateReader& file);
    void assemble();
    void assemble_output();
    coupler::ParticipantReport make_report() const;
    void finish(double wall_s);

    const scene::Scene& scene_;
    coupler::Session& session_;
    output::ProgressMode progress_mode_;
    FluidSolver& fluid_;
    coupler::TaskList tasks_;
    std::unique_ptr<coupler::FluidCoupling> coupling_;  // present only with a structure
    FluidRun run_;
    coupler::Outputs outputs_;
    std::unique_ptr<output::Progress> progress_;  // on the leading rank
};

}  // namespace magfsi::fluids
