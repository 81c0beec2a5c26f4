// SPDX-License-Identifier: GPL-2.0-or-later
// A fluid participant, whatever solver it drives: assembles the coupled step from what
// the scene names and runs it.
#pragma once

#include <memory>

#include "adapters/solvers/fluids/fluid_run.h"
#include "coupler/output/log.h"
#include "coupler/participants/session.h"
#include "coupler/scheme/fluid_coupling.h"
#include "coupler/step/report.h"
#include "coupler/step/task_list.h"

namespace magfsi::fluids {

// Runs a fluid solver from the session's step to the end, alone or coupled to a
// structure. All calls are collective over the fluid's ranks.
class Participant {
  public:
    // fluid must stand at the session's step; scene, session and fluid must outlive this.
    // Restores the checkpoint if the session continues one. Throws coupler::StateFault.
    Participant(const scene::Scene& scene, coupler::Session& session, FluidSolver& fluid,
                output::ProgressMode progress);
    // Runs all steps, then writes the summary or, in a coupled run, sends the report to
    // the structure. Throws coupler::Diverged, PartnerLost or Stopped.
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
