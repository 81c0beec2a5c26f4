// A fluid as a participant, whatever solves it: its coupled step, assembled from the
// scene.
#pragma once

#include <memory>

#include "adapters/fluids/fluid_files.h"
#include "adapters/fluids/fluid_solver.h"
#include "coupler/checkpoint/checkpoints.h"
#include "coupler/output/probe_file.h"
#include "coupler/output/progress.h"
#include "coupler/participants/session.h"
#include "coupler/scheme/fluid_coupling.h"
#include "coupler/step/report.h"
#include "coupler/step/task_list.h"

namespace magfsi::fluids {

class Participant {
  public:
    // fluid: at the session's step and state; both outlive this.
    Participant(coupler::Session& session, FluidSolver& fluid,
                output::ProgressMode progress);
    void run();

  private:
    void assemble();
    void assemble_output();
    void assemble_checkpoint();
    coupler::BalanceRecord* balance() const;  // null where the scene has none
    void write_probes();
    coupler::ParticipantReport make_report(double wall_s) const;
    void finish(double wall_s);

    coupler::Session& session_;
    output::ProgressMode progress_mode_;
    FluidSolver& fluid_;
    coupler::TaskList tasks_;
    std::unique_ptr<coupler::FluidCoupling> coupling_;  // present only with a structure
    // Present only when the scene names them:
    std::unique_ptr<FluidFiles> files_;
    std::unique_ptr<output::ProbeFile> probes_;
    std::unique_ptr<output::Progress> progress_;
    std::unique_ptr<coupler::Checkpoints> checkpoints_;
    bool writes_probes_ = false;
};

}  // namespace magfsi::fluids
