#include "adapters/lammps/participant.h"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/bodies/fluid_inside.h"
#include "adapters/lammps/audit/collect_terms.h"
#include "adapters/lammps/generated_input.h"
#include "adapters/lammps/scene_to_input.h"
#include "coupler/checkpoint/checkpoints.h"
#include "coupler/participants/errors.h"
#include "coupler/step/report.h"
#include "structure/lammps/register_styles.h"

namespace magfsi::lammps {

namespace {

constexpr const char* advance_task = "advance structure";

}  // namespace

Participant::Participant(const scene::Scene& scene, coupler::Session& session,
                         const Substeps& substeps,
                         const coupler::ParticipantArguments& arguments)
    : scene_(scene), session_(session), substeps_(substeps) {
    build();
    run_->recorded = arguments.record;
    assemble();
    assemble_output(arguments.progress);
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
    run_.emplace(StructureRun{.scene = scene_,
                              .session = session_,
                              .engine = *engine_,
                              .input = input_,
                              .fix_ids = fix_ids_,
                              .atoms = atoms_});
    if (scene().fluid && session_.world().root())
        run_->whole_mass_kg = bodies::whole_masses_kg(scene());
    run_->start = run_->gather();
    if (!scene().time.equilibrium) {
        guard_ = std::make_unique<StepGuard>(input_.bodies, at_start,
                                             session_.world().local());
    } else {
        rest_ = std::make_unique<RestFinder>(*engine_, scene(), substeps_.lammps_step_s);
    }
    if (session_.world().coupled()) {
        coupling_ =
            std::make_unique<BodyCoupling>(scene_, session_, *engine_, script.first_node);
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
    if (coupling_ && scene().coupling->scheme == coupler::Scheme::implicit) {
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
    if (coupling.scheme == coupler::Scheme::parallel) {
        tasks_.add_coupling("take mean fluid velocity",
                            [this] { coupling_->begin_step_with_mean(); });
    } else if (coupling.sampled_velocity == coupler::SampledVelocity::linear) {
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
    tasks_.add_coupling("check convergence", [this] { again_ = coupling_->repeat(); });
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
    run_->coupling = coupling_.get();
    run_->balance = balance_.get();
    run_->audit = audit_.get();
    run_->state = [this] {
        StructureParts all = parts();
        all.counted = &counted_;
        return all;
    };
    outputs_.add(structure_outputs(), *run_, tasks_);
    run_->start = {};
    outputs_.need(scene().probes.has_value(), "probes");
    outputs_.need(scene().output.structure.has_value(), "structure_fields");
    outputs_.need(scene().checkpoint.has_value(), "checkpoint");
    outputs_.need(run_->recorded, "record");
    if (!session_.world().leads()) return;
    progress_ = coupler::progress_on_stdout(session_, progress);
    tasks_.add_output("progress", [this] { progress_->update(session_.clock().step()); });
}

StructureParts Participant::parts() {
    return {scene_,          session_,       *engine_,     atoms_,
            coupling_.get(), balance_.get(), audit_.get(), substeps_.count};
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
    if (rest_ && !session_.restart()) rest_->find(0);
    outputs_.begin();
    const double start = output::steady_seconds();
    while (session_.running()) tasks_.run();
    finish(output::steady_seconds() - start);
}

coupler::ParticipantReport Participant::make_report() const {
    auto report = coupler::basic_report(session_.world(), tasks_);
    output::StructureSummary structure;
    for (const auto& body : input_.bodies) {
        structure.elements += static_cast<std::int64_t>(body.mesh.elements.size());
    }
    // With fewer elements a LAMMPS step is mostly communication.
    constexpr std::int64_t fewest_elements_a_rank = 500;
    report.load.max_ranks = static_cast<int>(
        std::max<std::int64_t>(1, structure.elements / fewest_elements_a_rank));
    add_steps(structure);
    if (const double seconds = tasks_.seconds(advance_task); seconds > 0) {
        const auto* repeated = coupling_ ? coupling_->repetitions() : nullptr;
        const std::int64_t advances =
            repeated ? repeated->iterations : session_.clock().steps_here();
        structure.ns_per_element_step = 1e9 * seconds /
                                        (static_cast<double>(advances) * mean_substeps() *
                                         static_cast<double>(structure.elements));
    }
    report.add(structure);
    if (coupling_) {
        const auto boundary = coupler::boundary_summary(
            coupling_->slip(), session_.plan().given_speed_m_s);
        report.add(boundary);
        session_.log(coupler::to_text(boundary));
    }
    if (audit_) report.add(audit_->summary());
    if (coupling_ && coupling_->repetitions())
        report.add(*coupling_->repetitions());
    return report;
}

void Participant::finish(double wall_s) {
    std::vector<coupler::ParticipantReport> reports{make_report()};
    if (session_.world().coupled()) {
        reports.push_back(coupler::receive_report(session_));
    }
    if (!session_.world().leads()) return;
    outputs_.finish();
    progress_->finish(session_.clock().step());
    coupler::write_summary(session_, reports, wall_s, outputs_.probes());
    session_.log(coupler::end_line(session_, wall_s));
}

}  // namespace magfsi::lammps
