// The magttice in LAMMPS as a participant: its coupled step, assembled from the scene.
#pragma once

#include <memory>
#include <optional>

#include "adapters/lammps/audit/energy_audit.h"
#include "adapters/lammps/body_coupling.h"
#include "adapters/lammps/come_to_rest.h"
#include "adapters/lammps/step_guard.h"
#include "adapters/lammps/structure_run.h"
#include "adapters/lammps/substeps.h"
#include "coupler/output/log.h"
#include "coupler/participants/session.h"
#include "coupler/step/task_list.h"
#include "coupler/step/report.h"

namespace magfsi::lammps {

class Participant {
  public:
    Participant(const scene::Scene& scene, coupler::Session& session,
                const Substeps& substeps,
                const coupler::ParticipantArguments& arguments);
    void run();

  private:
    void build();
    void assemble();
    void assemble_start();
    void assemble_coupling();
    std::int64_t steps_between_samples() const;
    void assemble_iterations();
    void add_advance();
    void add_step_guard();
    void take_substeps_of_restart();
    void add_slip();
    void assemble_output(output::ProgressMode progress);
    StructureParts parts();
    void check_finite() const;
    void add_steps(output::StructureSummary& structure) const;
    double mean_substeps() const;
    coupler::ParticipantReport make_report() const;
    void finish(double wall_s);

    const scene::Scene& scene() const { return scene_; }

    const scene::Scene& scene_;
    coupler::Session& session_;
    Substeps substeps_;
    StepCount counted_;
    structure::LammpsInput input_;
    std::vector<std::string> fix_ids_;  // of each body's fix magttice
    int atoms_ = 0;
    std::unique_ptr<Engine> engine_;
    coupler::TaskList tasks_;
    std::unique_ptr<RestFinder> rest_;  // present only for equilibria
    std::unique_ptr<StepGuard> guard_;  // present only for motion
    // Present only with a fluid:
    std::unique_ptr<BodyCoupling> coupling_;
    bool again_ = false;  // implicit scheme: the step is repeated
    std::unique_ptr<coupler::BalanceRecord> balance_;
    std::unique_ptr<EnergyAudit> audit_;  // only when the scene asks for it
    std::optional<StructureRun> run_;
    coupler::Outputs outputs_;
    std::unique_ptr<output::Progress> progress_;  // on the leading rank
};

}  // namespace magfsi::lammps
