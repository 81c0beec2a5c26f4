// The magttice in LAMMPS as a participant: its coupled step, assembled from the scene.
#pragma once

#include <memory>

#include "adapters/bodies/probe_row.h"
#include "adapters/bodies/structure_files.h"
#include "adapters/lammps/audit/energy_audit.h"
#include "adapters/lammps/body_coupling.h"
#include "adapters/lammps/come_to_rest.h"
#include "adapters/lammps/exchange_recorder.h"
#include "adapters/lammps/step_guard.h"
#include "adapters/lammps/structure_state.h"
#include "adapters/lammps/substeps.h"
#include "coupler/checkpoint/checkpoints.h"
#include "coupler/output/probe_file.h"
#include "coupler/output/progress.h"
#include "coupler/participants/session.h"
#include "coupler/step/report.h"
#include "coupler/step/task_list.h"

namespace magfsi::lammps {

class Participant {
  public:
    Participant(coupler::Session& session, const Substeps& substeps,
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
    void assemble_checkpoint();
    void assemble_record();
    void start_anew();
    StructureParts parts();
    NodalState gather();
    void add_audit(double fluid_kinetic_j, std::vector<double>& row);
    void write_probes();
    void write_fields();
    std::vector<bodies::BodyLoads> collect_loads();
    double add_partner_values(std::vector<double>& row);
    void check_finite() const;
    void add_steps(output::StructureSummary& structure) const;
    double mean_substeps() const;
    coupler::ParticipantReport make_report() const;
    void finish(double wall_s);

    const scene::Scene& scene() const { return session_.scene(); }

    coupler::Session& session_;
    Substeps substeps_;
    StepCount counted_;
    structure::LammpsInput input_;
    std::vector<std::string> fix_ids_;  // of each body's fix magttice
    int atoms_ = 0;
    std::vector<double> whole_mass_kg_;  // with a fluid, on the root
    std::unique_ptr<Engine> engine_;
    coupler::TaskList tasks_;
    std::unique_ptr<RestFinder> rest_;  // present only for equilibria
    std::unique_ptr<StepGuard> guard_;  // present only for motion
    // Present only with a fluid:
    std::unique_ptr<BodyCoupling> coupling_;
    bool again_ = false;  // implicit scheme: the step is repeated
    std::unique_ptr<coupler::BalanceRecord> balance_;
    std::unique_ptr<ExchangeRecorder> recorder_;  // with --record
    std::unique_ptr<EnergyAudit> audit_;          // only when the scene asks for it
    // Present only when the scene names them, and only on the root:
    std::unique_ptr<bodies::ProbeRow> probe_row_;
    std::unique_ptr<bodies::StructureFiles> files_;
    std::unique_ptr<output::ProbeFile> probes_;
    std::unique_ptr<coupler::Checkpoints> checkpoints_;  // on every rank
    std::unique_ptr<output::Progress> progress_;
};

}  // namespace magfsi::lammps
