#include "adapters/lammps/participant.h"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/bodies/fluid_inside.h"
#include "adapters/lammps/audit/collect_terms.h"
#include "adapters/lammps/generated_input.h"
#include "adapters/lammps/scene_to_input.h"
#include "coupler/checkpoint/open_restart.h"
#include "coupler/participants/errors.h"
#include "coupler/step/boundary_quality.h"
#include "coupler/step/log_head.h"
#include "coupler/step/probe_columns.h"
#include "coupler/step/progress_line.h"
#include "structure/lammps/register_styles.h"

namespace magfsi::lammps {

namespace {

constexpr const char* advance_task = "advance structure";

}  // namespace

Participant::Participant(coupler::Session& session, const Substeps& substeps,
                         const coupler::ParticipantArguments& arguments)
    : session_(session), substeps_(substeps) {
    build();
    assemble();
    assemble_output(arguments.progress);
    if (arguments.record) assemble_record();
}

void Participant::build() {
    const Substeps at_start = substeps_;
    counted_.fewest = substeps_.count;
    if (session_.restart()) take_substeps_of_restart();
    input_ = to_lammps_input(scene(), substeps_.lammps_step_s);
    if (scene().time.equilibrium) prepare_for_rest(input_, scene());
    const auto script =
        generate_input(session_, input_, session_.clock().steps() * substeps_.count);
    structure::set_failure_handler(
        [](const std::string& cause) { throw coupler::Diverged(cause); });
    engine_ =
        std::make_unique<Engine>(session_.world().local(), session_.out() / "lammps.log");
    for (const std::string& line : script.setup) engine_->command(line);
    if (session_.restart()) engine_->start_at(session_.clock().step() * substeps_.count);
    engine_->set_up();

    fix_ids_ = script.fix_id;
    atoms_ = script.first_node.back() - 1;
    if (scene().fluid && session_.world().root())
        whole_mass_kg_ = bodies::whole_masses_kg(scene());
    const NodalState start = gather();
    if (session_.world().root()) {
        if (scene().probes)
            probe_row_ =
                std::make_unique<bodies::ProbeRow>(scene(), input_.bodies, start);
        if (scene().output.structure) {
            files_ = std::make_unique<bodies::StructureFiles>(input_.bodies, start,
                                                              session_.out());
        }
    }
    if (!scene().time.equilibrium) {
        guard_ = std::make_unique<StepGuard>(input_.bodies, at_start,
                                             session_.world().local());
    } else {
        rest_ = std::make_unique<RestFinder>(*engine_, scene(), substeps_.lammps_step_s);
    }
    if (session_.world().coupled()) {
        coupling_ = std::make_unique<BodyCoupling>(session_, *engine_, script.first_node);
        if (scene().probes && scene().probes->interface_balance) {
            balance_ = std::make_unique<coupler::BalanceRecord>();
        }
    }
    if (scene().probes && scene().probes->energy_audit) {
        audit_ = std::make_unique<EnergyAudit>(scene(), engine_->gather(atoms_));
        attach_audit(*engine_, input_);
    }
    if (session_.restart()) restore_bodies(parts(), coupler::open_restart(session_));
}

void Participant::assemble() {
    if (guard_) add_step_guard();
    if (coupling_ && scene().coupling->scheme == scene::Scheme::implicit) {
        assemble_iterations();
        tasks_.add("count step", [this] { session_.complete_step(); });
        return;
    }
    if (coupling_) assemble_start();
    if (rest_) {
        tasks_.add("come to rest", [this] {
            rest_->find(static_cast<double>(session_.clock().step() + 1) *
                        session_.clock().step_s());
        });
        tasks_.add("check finite", [this] { check_finite(); });
    } else {
        add_advance();
    }
    if (coupling_) assemble_coupling();
    tasks_.add("count step", [this] { session_.complete_step(); });
}

void Participant::add_advance() {
    tasks_.add(advance_task, [this] { engine_->advance(substeps_.count); });
    tasks_.add("check finite", [this] { check_finite(); });
}

void Participant::assemble_start() {
    const auto& coupling = *scene().coupling;
    if (coupling.scheme == scene::Scheme::parallel) {
        tasks_.add_coupling("take mean fluid velocity",
                            [this] { coupling_->begin_step_with_mean(); });
    } else if (coupling.sampled_velocity == scene::SampledVelocity::linear) {
        tasks_.add_coupling("extrapolate fluid velocity",
                            [this] { coupling_->begin_step_extrapolated(); });
    } else {
        tasks_.add_coupling("take fluid velocity", [this] { coupling_->begin_step(); });
    }
}

// Implicit: a guess of the fluid's velocities at the step's end, both sides' steps under
// it, the fluid's answer; again until the two are the same.
void Participant::assemble_iterations() {
    tasks_.add("keep state", [this] { coupling_->keep_state(); });
    const std::size_t first = tasks_.size();
    tasks_.add_coupling("guess fluid velocity", [this] { coupling_->begin_iteration(); });
    add_advance();
    tasks_.add_coupling("send impulses", [this] { coupling_->send_impulses(); });
    tasks_.add_coupling("wait for fluid", [this] { coupling_->receive_answer(); });
    tasks_.add_coupling("judge answer", [this] { again_ = coupling_->repeat(); });
    tasks_.repeat_from(first, [this] { return again_; });
    if (balance_)
        tasks_.add_coupling("audit interface", [this] { coupling_->audit(*balance_); });
    tasks_.add_coupling("take fluid velocity", [this] { coupling_->accept_answer(); });
    add_slip();
}

void Participant::assemble_coupling() {
    tasks_.add_coupling("send impulses", [this] { coupling_->send_impulses(); });
    if (coupling_->iterates())
        tasks_.add_coupling("iterate forcing", [this] { coupling_->iterate_forcing(); });
    if (balance_)
        tasks_.add_coupling("audit interface", [this] { coupling_->audit(*balance_); });
    tasks_.add_coupling("wait for fluid", [this] { coupling_->receive_velocities(); });
    add_slip();
}

void Participant::add_slip() {
    tasks_.add_output("measure slip", [this, every = steps_between_samples()] {
        if ((session_.clock().step() + 1) % every == 0) coupling_->measure_slip();
    });
}

// With the probe rows, or a hundred times in a run without.
std::int64_t Participant::steps_between_samples() const {
    const coupler::Clock& clock = session_.clock();
    if (scene().probes) return clock.every(scene().probes->every_s);
    return std::max<std::int64_t>(1, clock.steps() / 100);
}

void Participant::assemble_output(output::ProgressMode progress) {
    const bool leads = session_.world().leads();
    if (scene().probes) {
        if (leads) {
            std::vector<std::string> columns = coupler::body_columns(scene());
            for (const auto& more :
                 {coupler::fluid_columns(scene()), coupler::interface_columns(scene()),
                  audit_ ? audit_->columns() : std::vector<std::string>{}}) {
                columns.insert(columns.end(), more.begin(), more.end());
            }
            probes_ = coupler::open_probes(session_, columns);
        }
        tasks_.add_output(
            "probes", [this, every = session_.clock().every(scene().probes->every_s)] {
                if (session_.clock().step() % every == 0) write_probes();
            });
    }
    if (scene().output.structure) {
        if (session_.restart() && files_)
            files_->resume(session_.clock(),
                           session_.clock().every(scene().output.structure->every_s));
        tasks_.add_output(
            "write fields",
            [this, every = session_.clock().every(scene().output.structure->every_s)] {
                if (session_.clock().step() % every == 0) write_fields();
            });
    }
    if (scene().checkpoint) assemble_checkpoint();
    if (leads) {
        progress_ = coupler::progress_on_stdout(session_, progress);
        tasks_.add_output("progress",
                          [this] { progress_->update(session_.clock().step()); });
    }
}

void Participant::assemble_checkpoint() {
    checkpoints_ = std::make_unique<coupler::Checkpoints>(
        session_, [this](coupler::StateWriter* file) {
            StructureParts all = parts();
            all.counted = &counted_;
            save_structure(all, file);
        });
    tasks_.add_output("checkpoint", [this] { checkpoints_->end_step(); });
}

void Participant::assemble_record() {
    if (!coupling_)
        throw std::invalid_argument("--record: without a fluid nothing is exchanged");
    if (coupling_->iterates())
        throw std::invalid_argument(
            "--record: coupling.immersed_boundary.iterations above 1 exchange more "
            "messages a step than a record holds; take iterations: 1");
    if (coupling_->repetitions()) {
        throw std::invalid_argument(
            "--record: an implicit step has many exchanges, which cannot be played; take "
            "coupling.scheme: serial");
    }
    recorder_ = std::make_unique<ExchangeRecorder>(
        session_, *coupling_, coupler::fluid_columns(scene()).size());
    tasks_.add_output("record exchange",
                      [this] { recorder_->record(session_.clock().step() - 1); });
}

StructureParts Participant::parts() {
    return {session_,       *engine_,     atoms_,         coupling_.get(),
            balance_.get(), audit_.get(), substeps_.count};
}

// A NaN in one node reaches its neighbours in the next substep: one look a coupled step
// is enough to name the place.
void Participant::check_finite() const {
    const int node = engine_->atom_without_place();
    if (node == 0) return;
    throw coupler::Diverged(fmt::format(
        "the structure diverged: node {} has no finite position at step {}; take more "
        "coupling.substeps, a finer mesh or a weaker field",
        node, session_.clock().step()));
}

std::vector<bodies::BodyLoads> Participant::collect_loads() {
    std::vector<bodies::BodyLoads> loads(input_.bodies.size());
    if (coupling_ && bodies::ProbeRow::wants(scene(), scene::BodyQuantity::fluid_force)) {
        const auto forces = coupling_->force_on_bodies();
        for (std::size_t b = 0; b < loads.size(); ++b) loads[b].fluid_force_n = forces[b];
    }
    if (bodies::ProbeRow::wants(scene(), scene::BodyQuantity::energy)) {
        for (std::size_t b = 0; b < loads.size(); ++b) {
            loads[b].energy_elastic_j = engine_->fix_vector(fix_ids_[b], 1);
            loads[b].work_magnetic_j = engine_->fix_vector(fix_ids_[b], 3);
        }
    }
    return loads;
}

// Returns what the fluid's last column is, on the root.
double Participant::add_partner_values(std::vector<double>& row) {
    const std::size_t fluid_values = coupler::fluid_columns(scene()).size();
    const auto given =
        balance_ ? balance_->collect(session_.world().local()) : std::vector<double>{};
    if (!session_.world().root() || (fluid_values == 0 && !balance_)) return 0;
    std::vector<double> numbers(fluid_values + given.size());
    coupler::receive_numbers(session_.world(), session_.clock().step(), numbers,
                             session_.timeout_s());
    const std::span<const double> all(numbers);
    if (recorder_) recorder_->keep_numbers(all.first(fluid_values));
    row.insert(row.end(), all.begin(),
               all.begin() + static_cast<std::ptrdiff_t>(fluid_values));
    const double last = fluid_values > 0 ? numbers[fluid_values - 1] : 0;
    if (!balance_) return last;
    const auto mismatch = coupler::worst_mismatch(given, all.subspan(fluid_values));
    row.push_back(mismatch.momentum);
    row.push_back(mismatch.power);
    return last;
}

// The fluid's kinetic energy comes last of its columns. Collective.
void Participant::add_audit(double fluid_kinetic_j, std::vector<double>& row) {
    const NodalState nodes = engine_->gather(atoms_);
    EnergyTerms terms =
        collect_terms(*engine_, scene(), fix_ids_,
                      coupling_ ? coupling_->work() : nullptr, session_.world().local());
    if (!session_.world().root()) return;
    if (coupling_) terms.fluid_kinetic = fluid_kinetic_j;
    const auto values = audit_->row(nodes, terms);
    row.insert(row.end(), values.begin(), values.end());
}

// With the bodies' whole masses, whatever came off their nodes. Collective.
NodalState Participant::gather() {
    NodalState state = engine_->gather(atoms_);
    if (!whole_mass_kg_.empty()) state.mass_kg = whole_mass_kg_;
    return state;
}

// Collective; only the root goes on to the row.
void Participant::write_probes() {
    const NodalState state = gather();
    const auto loads = collect_loads();
    const auto on_parts = coupling_ ? coupling_->force_on_parts() : std::vector<Vec3>{};
    std::vector<double> row;
    if (probe_row_) {
        row = probe_row_->values(session_.clock().time_s(), state, loads, on_parts);
    }
    const double fluid_j = coupling_ ? add_partner_values(row) : 0;
    if (audit_) add_audit(fluid_j, row);
    if (!probes_) return;
    probes_->row(session_.clock().time_s(), row);
    const std::string fault = audit_ ? audit_->fault() : std::string{};
    if (!fault.empty())
        throw coupler::Diverged(
            fmt::format("after {:.6g} s {}", session_.clock().time_s(), fault));
}

// Collective; only the root goes on to the file.
void Participant::write_fields() {
    const auto every = session_.clock().every(scene().output.structure->every_s);
    const NodalState state = gather();
    if (files_)
        files_->write(session_.clock().step() / every, session_.clock().time_s(), state);
}

void Participant::run() {
    session_.log(
        rest_ ? fmt::format("scene '{}': equilibria by damped motion at {} points",
                            scene().name, session_.clock().steps())
              : fmt::format("scene '{}' to {:.6g} s in {} steps of {:.4g} us, each of {} "
                            "LAMMPS steps",
                            scene().name, scene().time.end_s, session_.clock().steps(),
                            substeps_.coupled_step_s * 1e6, substeps_.count));
    coupler::log_effects(session_);
    coupler::log_steps(session_, tasks_);
    if (session_.restart() && coupling_)
        restore_coupling(parts(), coupler::open_restart(session_));
    if (coupling_) coupling_->exchange_first();
    if (!session_.restart()) start_anew();
    if (recorder_) recorder_->record(session_.clock().step() - 1);
    const double start = output::steady_seconds();
    while (session_.running()) tasks_.run();
    finish(output::steady_seconds() - start);
}

void Participant::start_anew() {
    if (rest_) rest_->find(0);
    if (scene().probes) write_probes();
    if (scene().output.structure) write_fields();
}

coupler::ParticipantReport Participant::make_report() const {
    auto report = coupler::basic_report(session_.world(), tasks_);
    output::StructureSummary structure;
    for (const auto& body : input_.bodies) {
        structure.elements += static_cast<std::int64_t>(body.mesh.elements.size());
    }
    // With fewer elements a LAMMPS step is mostly communication.
    constexpr std::int64_t fewest_elements_a_rank = 500;
    report.load.most_ranks = static_cast<int>(
        std::max<std::int64_t>(1, structure.elements / fewest_elements_a_rank));
    add_steps(structure);
    for (const auto& [task, seconds] : tasks_.timer().seconds()) {
        if (task != advance_task) continue;
        const auto* repeated = coupling_ ? coupling_->repetitions() : nullptr;
        const std::int64_t advances =
            repeated ? repeated->iterations : session_.clock().steps_here();
        structure.ns_per_element_step = 1e9 * seconds /
                                        (static_cast<double>(advances) * mean_substeps() *
                                         static_cast<double>(structure.elements));
    }
    report.structure = structure;
    if (coupling_) {
        report.immersed_boundary = coupler::boundary_summary(coupling_->slip(), scene());
        session_.log(coupler::to_text(*report.immersed_boundary));
    }
    if (audit_) report.energy_audit = audit_->summary();
    if (coupling_ && coupling_->repetitions())
        report.iterations = *coupling_->repetitions();
    return report;
}

void Participant::finish(double wall_s) {
    std::vector<coupler::ParticipantReport> reports{make_report()};
    if (session_.world().coupled()) {
        reports.push_back(coupler::report_from_text(coupler::swap_text(
            session_.world(), "", session_.timeout_s(), "final report")));
    }
    if (!session_.world().leads()) return;
    if (checkpoints_) checkpoints_->finish();
    progress_->finish(session_.clock().step());
    coupler::write_summary(session_, reports, wall_s, probes_.get());
    session_.log(coupler::end_line(session_, wall_s));
}

}  // namespace magfsi::lammps
