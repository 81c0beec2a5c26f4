// The lattice-Boltzmann fluid as a participant: its coupled step, assembled from the
// scene.
#pragma once

#include <memory>

#include "adapters/lbm/fluid_output.h"
#include "adapters/lbm/lbm_fluid.h"
#include "coupler/checkpoint/checkpoints.h"
#include "coupler/output/probe_file.h"
#include "coupler/output/progress.h"
#include "coupler/participants/session.h"
#include "coupler/scheme/fluid_coupling.h"
#include "coupler/step/report.h"
#include "coupler/step/task_list.h"

namespace magfsi::lbm {

class Participant {
  public:
    Participant(coupler::Session& session, output::ProgressMode progress);
    void run();

  private:
    void assemble();
    void assemble_output();
    void assemble_checkpoint();
    void restore();
    coupler::BalanceRecord* balance() const;  // null where the scene has none
    void write_probes();
    void check_divergence();
    coupler::ParticipantReport make_report(double wall_s) const;
    void finish(double wall_s);

    coupler::Session& session_;
    output::ProgressMode progress_mode_;
    fluid::Fluid fluid_;
    LbmFluid lbm_;
    coupler::TaskList tasks_;
    std::unique_ptr<coupler::FluidCoupling> coupling_;  // present only with a structure
    // Present only when the scene names them:
    std::unique_ptr<FluidFiles> files_;
    std::unique_ptr<output::ProbeFile> probes_;
    std::unique_ptr<output::Progress> progress_;
    std::unique_ptr<coupler::Checkpoints> checkpoints_;
    bool writes_probes_ = false;
};

}  // namespace magfsi::lbm
