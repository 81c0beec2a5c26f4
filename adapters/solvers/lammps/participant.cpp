// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-structure: the bodies of a scene in LAMMPS, alone or beside a fluid participant.
//   mpirun -n 1 magfsi-structure SCENE --out DIR : -n 2 magfsi-fluid-lbm SCENE --out DIR
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "adapters/run_scene.h"
#include "adapters/scene/checks.h"
#include "adapters/solvers/bodies/fluid_inside.h"
#include "adapters/solvers/bodies/surroundings.h"
#include "adapters/solvers/lammps/body_markers.h"
#include "adapters/solvers/lammps/come_to_rest.h"
#include "adapters/solvers/lammps/run_script.h"
#include "adapters/solvers/lammps/scene_to_input.h"
#include "adapters/solvers/lammps/structure_run.h"
#include "coupler/checkpoint/state_file.h"
#include "coupler/output/file.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/handshake.h"
#include "coupler/participants/waiting.h"
#include "coupler/participants/world.h"
#include "coupler/step/report.h"
#include "coupler/step/trace.h"
#include "structure/lammps/register_styles.h"

namespace magfsi::lammps {

#define MAGFSI_OUTPUT(name) extern const StructureOutput name##_output;
#include "adapters/solvers/lammps/outputs.inc"
#undef MAGFSI_OUTPUT

namespace {

// The outputs of this build; the list ends with one that has no name.
const StructureOutput* structure_outputs() {
#define MAGFSI_OUTPUT(name) name##_output,
    static const StructureOutput registered[] = {
#include "adapters/solvers/lammps/outputs.inc"
        {}};
#undef MAGFSI_OUTPUT
    return registered;
}

// The structure's side of a run, from the script to the summary.
class Participant {
  public:
    // Begins the session. solids: the scene's bodies, which are not kept.
    Participant(const scene::Scene& scene, const bodies::Solids& solids,
                coupler::Session& session,
                const coupler::ParticipantArguments& arguments);
    void run();

  private:
    void take_substeps_of_restart();
    void start_lammps(const bodies::Solids& solids);
    void build_coupling(const bodies::Solids& solids, const std::vector<int>& first_node);
    void assemble();
    void assemble_output(output::ProgressMode progress);
    template <class Use>
    void each_body(const std::vector<structure::Vec3>& all, const Use& use);
    void start_field_work();
    void come_to_rest(double time_s);
    void check_stable_step();
    output::StructureSummary summary() const;
    coupler::ParticipantReport make_report() const;
    void finish(double wall_s);

    const scene::Scene& scene_;
    coupler::Session& session_;
    Substeps at_start_;
    StructureRun run_;
    coupler::TaskList tasks_;
    std::unique_ptr<RestFinder> rest_;  // present only for equilibria
    std::unique_ptr<StepGuard> guard_;  // present only for motion
    coupler::Outputs outputs_;
    std::unique_ptr<output::Progress> progress_;  // on the leading rank
};

Participant::Participant(const scene::Scene& scene, const bodies::Solids& solids,
                         coupler::Session& session,
                         const coupler::ParticipantArguments& arguments)
    : scene_(scene),
      session_(session),
      run_{.scene = scene, .session = session, .input = to_lammps_input(scene, solids)} {
    run_.substeps = at_start_ = choose_substeps(scene, run_.input);
    session.begin(at_start_.coupled_step_s);
    run_.counted.fewest = at_start_.count;
    if (session_.restart()) take_substeps_of_restart();
    start_lammps(solids);
    if (session_.restart()) restore_bodies(run_, session_.open_restart());
    assemble();
    assemble_output(arguments.progress);
}

// Continues with the number of substeps of the checkpoint: the deformation may have
// raised it since the start.
void Participant::take_substeps_of_restart() {
    const auto& file = session_.open_restart();
    if (!file.has("substeps")) return;
    const auto kept = file.table("substeps");
    Substeps& substeps = run_.substeps;
    substeps.count = std::max(substeps.count, static_cast<int>(kept[0]));
    substeps.lammps_step_s = substeps.coupled_step_s / substeps.count;
    run_.counted = {static_cast<std::int64_t>(kept[1]), session_.clock().step(),
                    static_cast<int>(kept[2]), static_cast<std::int64_t>(kept[1])};
}

void Participant::start_lammps(const bodies::Solids& solids) {
    run_.input.time_step_s = run_.substeps.lammps_step_s;
    if (scene_.time.equilibrium) prepare_for_rest(run_.input, scene_);
    if (scene_.time.start == scene::RunStart::equilibrium && session_.world().root()) {
        session_.log("the start: equilibria by Newton's method");
        try {
            run_.input.start_m = bodies::equilibria_at_start(scene_, run_.input.bodies);
        } catch (const std::runtime_error& fault) {
            throw coupler::Diverged(fault.what());
        }
    }
    const int count = run_.substeps.count;
    const auto script =
        generate_input(session_, run_.input, session_.clock().steps() * count);
    structure::set_failure_handler(
        [](const std::string& cause) { throw coupler::Diverged(cause); },
        advice_if_unstable(scene_));
    const MPI_Comm comm = session_.world().local();
    run_.engine = std::make_unique<Engine>(comm, session_.out() / "lammps.log");
    Engine& engine = *run_.engine;
    for (const std::string& line : script.setup) engine.command(line);
    if (session_.restart()) engine.start_at(session_.clock().step() * count);
    engine.set_up();
    engine.set_substeps(count);

    run_.fix_ids = script.fix_id;
    run_.atoms = script.first_node.back() - 1;
    if (scene_.fluid && session_.world().root())
        run_.whole_mass_kg = bodies::whole_masses_kg(solids);
    run_.start = run_.gather();
    if (!run_.start.rigid.empty()) run_.rigid = {solids, run_.start.position_m};
    if (!scene_.time.equilibrium)
        guard_ = std::make_unique<StepGuard>(run_.input.bodies, at_start_, comm);
    else
        rest_ = std::make_unique<RestFinder>(engine, scene_, solids,
                                             run_.substeps.lammps_step_s);
    if (rest_) start_field_work();
    if (session_.world().coupled()) build_coupling(solids, script.first_node);
    if (scene_.probes && scene_.probes->energy_audit) {
        run_.audit =
            std::make_unique<EnergyAudit>(scene_, solids, engine.gather(run_.atoms));
        attach_audit(run_);
    }
}

// Receives the description of the grid from the fluid and places the markers in it.
void Participant::build_coupling(const bodies::Solids& solids,
                                 const std::vector<int>& first_node) {
    const coupler::Grid grid = coupler::grid_from_text(coupler::swap_text(
        session_.world(), "", coupler::no_timeout_s, "description of the grid"));
    auto markers =
        own_markers(scene_, solids, *run_.engine, first_node, grid, session_.clock());
    run_.coupling = coupler::make_structure_coupling(session_, *run_.engine, grid,
                                                     std::move(markers));
}

// The tasks of a step: those of the coupling, or without a fluid one advance of the
// bodies.
void Participant::assemble() {
    if (guard_) tasks_.add("check stable step", [this] { check_stable_step(); });
    if (run_.coupling) return run_.coupling->add_tasks(tasks_);
    if (rest_) {
        tasks_.add("come to rest", [this] {
            come_to_rest(static_cast<double>(session_.clock().step() + 1) *
                         session_.clock().step_s());
        });
    } else {
        tasks_.add(coupler::advance_structure, [this] { run_.engine->advance(); });
    }
    tasks_.add(coupler::check_finite,
               [this] { run_.engine->check_finite(session_.clock().step()); });
    tasks_.add("count step", [this] { session_.complete_step(); });
}

// Calls use(b, nodes) for each body b with its part of a list of the nodes of all bodies.
template <class Use>
void Participant::each_body(const std::vector<structure::Vec3>& all, const Use& use) {
    std::size_t first = 0;
    for (std::size_t b = 0; b < run_.input.bodies.size(); ++b) {
        const std::size_t count = run_.input.bodies[b].mesh.nodes.size();
        use(b, std::span(all).subspan(first, count));
        first += count;
    }
}

void Participant::start_field_work() {
    if (!scene_.magnetic_field || !session_.world().root()) return;
    each_body(run_.start.position_m, [&](std::size_t b, auto placed) {
        const structure::Body& body = run_.input.bodies[b];
        run_.field_work.emplace_back(body, std::vector(placed.begin(), placed.end()),
                                     bodies::is_let_go(body, scene_.bodies[b].initial),
                                     *scene_.magnetic_field);
    });
}

void Participant::come_to_rest(double time_s) {
    rest_->find(time_s);
    if (!scene_.magnetic_field) return;
    const NodalState nodes = run_.engine->gather(run_.atoms);
    if (run_.field_work.empty()) return;
    each_body(nodes.position_m, [&](std::size_t b, auto of_body) {
        run_.field_work[b].move_to(of_body, time_s);
    });
}

// Raises the number of substeps where the deformation has lowered the stable step.
void Participant::check_stable_step() {
    const std::int64_t step = session_.clock().step();
    if (step % guard_->every() != 0) return;
    Substeps& substeps = run_.substeps;
    const auto found = guard_->check(run_.engine->gather(run_.atoms), substeps);
    if (found.factor == 1) return;
    run_.counted.change(step, substeps.count);
    run_.engine->divide_step(found.factor);
    substeps.count *= found.factor;
    substeps.lammps_step_s /= found.factor;
    run_.engine->set_substeps(substeps.count);
    session_.log(fmt::format(
        "step {}: the bodies' deformation has lowered their stable step to {:.3g} us; "
        "from here on {} steps of {:.3g} us in a coupled step",
        step, found.limit_s * 1e6, substeps.count, substeps.lammps_step_s * 1e6));
}

void Participant::assemble_output(output::ProgressMode progress) {
    outputs_.add(structure_outputs(), run_, tasks_);
    run_.start = {};
    outputs_.need(
        scene_.coupling && scene_.coupling->overlap == coupler::OverlapRule::stop,
        "overlap");
    outputs_.need(scene_.probes.has_value(), "probes");
    outputs_.need(scene_.control.has_value(), "control");
    outputs_.need(scene_.output.structure.has_value(), "structure_fields");
    outputs_.need(scene_.checkpoint.has_value(), "checkpoint");
    if (!session_.world().leads()) return;
    progress_ = coupler::progress_on_stdout(session_, progress);
    tasks_.add_output("progress", [this] { progress_->update(session_.clock().step()); });
}

void Participant::run() {
    session_.log(
        rest_ ? fmt::format("scene '{}': equilibria by damped motion at {} points",
                            scene_.name, session_.clock().steps())
              : fmt::format("scene '{}' to {:.6g} s in {} steps of {:.4g} us, each of {} "
                            "LAMMPS steps",
                            scene_.name, scene_.time.end_s, session_.clock().steps(),
                            run_.substeps.coupled_step_s * 1e6, run_.substeps.count));
    coupler::log_effects(session_);
    coupler::log_steps(session_, tasks_);
    if (session_.restart() && run_.coupling)
        restore_coupling(run_, session_.open_restart());
    if (run_.coupling) run_.coupling->begin();
    if (rest_ && !session_.restart()) come_to_rest(0);
    outputs_.begin();
    const auto trace = coupler::trace_of(session_, tasks_);
    const double start = output::steady_seconds();
    while (session_.running()) tasks_.run();
    finish(output::steady_seconds() - start);
}

output::StructureSummary Participant::summary() const {
    output::StructureSummary structure;
    for (const auto& body : run_.input.bodies)
        structure.elements += body.mesh.elements.size();
    structure.substeps_per_step = run_.substeps.count;
    structure.substeps = session_.clock().step() * run_.substeps.count;
    const std::int64_t substeps =
        run_.counted.until(session_.clock().step(), run_.substeps.count);
    if (!rest_) {
        structure.substeps = substeps;
        if (run_.counted.fewest != run_.substeps.count)
            structure.fewest_substeps_per_step = run_.counted.fewest;
    }
    if (const double seconds = tasks_.seconds(coupler::advance_structure); seconds > 0) {
        const std::int64_t steps_here = session_.clock().steps_here();
        const auto mean_substeps =
            static_cast<double>(substeps - run_.counted.at_start) /
            static_cast<double>(std::max<std::int64_t>(1, steps_here));
        const std::int64_t advances =
            run_.coupling ? run_.coupling->advances() : steps_here;
        structure.ns_per_element_step =
            1e9 * seconds /
            (1.0 * advances * mean_substeps * static_cast<double>(structure.elements));
    }
    return structure;
}

coupler::ParticipantReport Participant::make_report() const {
    auto report = coupler::basic_report(session_.world(), tasks_);
    report.versions.emplace_back("LAMMPS", run_.engine->version());
    const output::StructureSummary structure = summary();
    // On fewer elements a LAMMPS step consists mostly of communication.
    constexpr std::int64_t fewest_elements_per_rank = 500;
    report.load.max_ranks = static_cast<int>(
        std::max<std::int64_t>(1, structure.elements / fewest_elements_per_rank));
    report.add(structure);
    if (run_.coupling) {
        const auto boundary = coupler::boundary_summary(run_.coupling->slip(),
                                                        session_.plan().given_speed_m_s);
        report.add(boundary);
        const bool can_hold =
            scene_.coupling->immersed_boundary.forcing == coupler::Forcing::penalty &&
            !scene::objection_to_no_slip(scene_);
        session_.log(coupler::to_text(boundary, can_hold));
    }
    if (run_.audit) report.add(run_.audit->summary());
    if (run_.coupling && run_.coupling->iterations())
        report.add(*run_.coupling->iterations());
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

}  // namespace

}  // namespace magfsi::lammps

int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(coupler::Role::structure,
                     "The soft bodies of a magfsi scene, in LAMMPS", argc, argv,
                     [](const scene::Scene& scene, coupler::Session& session,
                        const coupler::ParticipantArguments& arguments) {
                         if (scene.bodies.empty())
                             throw std::invalid_argument(
                                 "the scene has no bodies; use ./magfsi run SCENE, "
                                 "which starts what it has");
                         const auto& rest = scene.time.equilibrium;
                         if (rest && rest->method == scene::EquilibriumMethod::newton)
                             throw std::invalid_argument(
                                 "the scene asks for Newton's method; start "
                                 "magfsi-equilibrium for it");
                         lammps::Participant participant(scene, bodies::to_bodies(scene),
                                                         session, arguments);
                         participant.run();
                     });
}
