// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-equilibrium finds the static equilibria of a scene's bodies along their path of
// loads, in one process, by Newton's method.
//    magfsi-equilibrium SCENE --out DIR
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"
#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/field_work.h"
#include "adapters/solvers/bodies/nodal_state.h"
#include "adapters/solvers/bodies/probe_row.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "adapters/solvers/bodies/structure_files.h"
#include "adapters/solvers/bodies/surroundings.h"
#include "coupler/output/log.h"
#include "coupler/output/probe_file.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/session.h"
#include "coupler/step/report.h"
#include "coupler/step/task_list.h"
#include "coupler/step/trace.h"
#include "structure/equilibrium/newton.h"
#include "structure/lammps/placement.h"
#include "structure/lattice/lattice.h"

namespace magfsi::equilibrium {
namespace {

// Pushes a body off an unstable equilibrium: what is reported is a state in which a real
// body would come to rest.
structure::EquilibriumOptions to_options(const scene::Equilibrium& wanted) {
    structure::EquilibriumOptions options;
    options.tolerance = wanted.tolerance;
    options.leave_unstable = true;
    return options;
}

// True if a field, gravity, a field gradient, sources or a driven node act on the body:
// without any of them it stays as it was placed.
bool loaded(const structure::StaticLoads& loads) {
    return loads.field_t != structure::Vec3{} ||
           loads.gravity_m_s2 != structure::Vec3{} || loads.gradient != 0 ||
           loads.sources != 0 || std::ranges::any_of(loads.driven_m, [](const auto& u) {
               return u != structure::Vec3{};
           });
}

// The equilibria of one body along a path of loads. The time of the scene is the
// parameter of the path: loads are taken at t, inertia plays no part.
class LoadPath {
  public:
    // Finds the equilibrium at the start of the path. Throws std::invalid_argument if
    // none can exist (a body with weight that nothing holds), std::runtime_error if
    // Newton's method finds none. All references must outlive this object.
    LoadPath(const scene::Scene& scene, const scene::Body& described,
             const structure::Body& body, structure::Surroundings surroundings);

    const structure::Body& body() const { return body_; }
    // Positions of the nodes [m] before any load: flat, relaxed or turned, as the scene
    // places the body.
    const std::vector<structure::Vec3>& placed_m() const { return placed_m_; }
    // The equilibrium at the last point of the path that was reached.
    const structure::Equilibrium& now() const { return now_; }
    // Lumped mass of each node [kg], for probes only: no inertia acts.
    const std::vector<double>& masses_kg() const { return mass_kg_; }
    // Elastic energy, work of the field and reactions of the supports at the present
    // point.
    bodies::BodyLoads loads() const;

    // Follows the equilibrium from the present point to the loads at to_s [s].
    void advance(double to_s);
    // True if the body was loaded, but at no point by enough: rounding leaves an error of
    // more than 1 % in its displacements (structure::Equilibrium::resolved).
    bool unresolved() const { return loaded_ && !resolved_; }

  private:
    structure::StaticLoads loads_at(double time_s) const {
        return bodies::loads_at(scene_, described_, time_s);
    }
    // Notes whether the body is loaded at this point and whether its shape is resolved
    // there.
    void note_point(const structure::StaticLoads& loads);
    const scene::Scene& scene_;
    const scene::Body& described_;
    structure::Body body_;
    std::vector<structure::Vec3> placed_m_;
    std::vector<double> mass_kg_;
    // Work of the magnetic field along the path; absent without a field.
    std::optional<bodies::FieldWork> work_;
    structure::NewtonSolver solver_;
    structure::Equilibrium now_;
    double time_s_ = 0;
    // Points so far: at least one with loads; at least one with a resolved equilibrium.
    bool loaded_ = false, resolved_ = false;
};

LoadPath::LoadPath(const scene::Scene& scene, const scene::Body& described,
                   const structure::Body& body, structure::Surroundings surroundings)
    : scene_(scene),
      described_(described),
      body_(body),
      solver_(body_, to_options(*scene.time.equilibrium), std::move(surroundings)) {
    const auto& field = scene.magnetic_field;
    placed_m_ = structure::placed_nodes(body_, described.initial,
                                        field ? field->plane : std::array<int, 2>{0, 2});
    mass_kg_ = structure::build_lattice(body_).node_mass_kg;
    const structure::StaticLoads start = loads_at(0);
    now_.nodes_m = placed_m_;
    now_.support_n.resize(placed_m_.size());
    // A clamped body takes its first load in increments; a free one is released under the
    // whole load and settles wherever it comes to rest.
    const bool at_rest = bodies::is_let_go(body_, described.initial);
    if (field) work_.emplace(body_, placed_m_, at_rest, *field);
    if (loaded(start) || scene.platform) {
        now_ = at_rest ? solver_.release(placed_m_, start)
                       : solver_.follow(placed_m_, {}, {&start, 1}).front();
        // The scene asks for this release, so it is not reported.
        if (at_rest) now_.releases = 0;
    }
    note_point(start);
    if (work_) work_->move_to(now_.nodes_m, 0);
}

void LoadPath::advance(double to_s) {
    const structure::StaticLoads before = loads_at(time_s_), after = loads_at(to_s);
    now_ = solver_.follow(now_.nodes_m, before, {&after, 1}).front();
    note_point(after);
    if (work_) work_->move_to(now_.nodes_m, to_s);
    time_s_ = to_s;
}

void LoadPath::note_point(const structure::StaticLoads& loads) {
    if (!loaded(loads)) return;
    loaded_ = true;
    resolved_ = resolved_ || now_.resolved();
}

bodies::BodyLoads LoadPath::loads() const {
    bodies::BodyLoads loads;
    loads.energy_elastic_j = now_.energy_elastic_j;
    if (work_) loads.work_magnetic_j = work_->work_j();
    loads.support_n = now_.support_n;
    return loads;
}

// Appends the nodes of a body at rest: positions [m], masses [kg] and zero velocities.
void append(bodies::NodalState& state, const std::vector<structure::Vec3>& position_m,
            const std::vector<double>& mass_kg) {
    state.position_m.insert(state.position_m.end(), position_m.begin(), position_m.end());
    state.mass_kg.insert(state.mass_kg.end(), mass_kg.begin(), mass_kg.end());
    state.velocity_m_s.resize(state.position_m.size());
}

// Calls work and turns its std::runtime_error, "no equilibrium found", into a Diverged,
// so that the run ends with the exit code of a divergence.
template <class Work>
void or_diverged(const Work& work) {
    try {
        work();
    } catch (const std::runtime_error& fault) {
        throw coupler::Diverged(fault.what());
    }
}

// The participant of a static scene: a coupled step is one point on the path of loads, at
// which the equilibria of all bodies are found and written.
class Participant {
  public:
    // Finds the equilibria at the start of the path. To be called after session.begin.
    Participant(const scene::Scene& scene, coupler::Session& session,
                output::ProgressMode progress);
    // Runs the whole path and writes all outputs. Throws Diverged if an equilibrium is
    // not found or if the loads of a body are too small to resolve its shape.
    void run();

  private:
    void assemble(output::ProgressMode progress);
    // Moves all bodies to the next point of the path.
    void advance();
    // Logs a snap to another branch, an unresolved shape or an unstable equilibrium.
    void report_branch(const LoadPath& path, double time_s);
    void write_probes();
    void write_fields();
    // Nodes of all bodies, one body after the other, at their present equilibria.
    bodies::NodalState state() const;
    void finish(double wall_s);

    const scene::Scene& scene_;
    coupler::Session& session_;
    double start_s_ = output::steady_seconds();  // before the first equilibrium
    // One path per body, in the scene's order.
    std::vector<std::unique_ptr<LoadPath>> paths_;
    coupler::TaskList tasks_;
    int iterations_ = 0;  // Newton iterations of all bodies and points
    // The outputs; null unless the scene names them.
    std::unique_ptr<bodies::ProbeRow> probe_row_;
    std::unique_ptr<output::ProbeFile> probes_;
    std::unique_ptr<bodies::StructureFiles> files_;
    std::unique_ptr<output::Progress> progress_;
};

Participant::Participant(const scene::Scene& scene, coupler::Session& session,
                         output::ProgressMode progress)
    : scene_(scene), session_(session) {
    const auto solids = bodies::to_bodies(scene);
    bodies::NodalState start;
    const auto surroundings = bodies::to_surroundings(scene, solids);
    for (std::size_t b = 0; b < solids.size(); ++b) {
        or_diverged([&] {
            paths_.push_back(std::make_unique<LoadPath>(scene, scene.bodies[b], solids[b],
                                                        surroundings[b]));
        });
        const LoadPath& path = *paths_.back();
        report_branch(path, 0);
        append(start, path.placed_m(), path.masses_kg());
    }
    if (scene.probes) {
        probe_row_ = std::make_unique<bodies::ProbeRow>(scene, solids, start);
        probes_ = std::make_unique<output::ProbeFile>(session.out() / "probes.csv",
                                                      probe_row_->columns());
    }
    if (scene.output.structure)
        files_ =
            std::make_unique<bodies::StructureFiles>(scene, solids, start, session.out());
    assemble(progress);
}

void Participant::assemble(output::ProgressMode progress) {
    tasks_.add("find equilibrium", [this] { advance(); });
    tasks_.add("count step", [this] { session_.complete_step(); });
    if (probes_) tasks_.add("probes", [this] { write_probes(); });
    if (files_) {
        tasks_.add(
            "write fields",
            [this, every = session_.clock().every(scene_.output.structure->every_s)] {
                if (session_.clock().step() % every == 0) write_fields();
            });
    }
    progress_ = coupler::progress_on_stdout(session_, progress);
    tasks_.add("progress", [this] { progress_->update(session_.clock().step()); });
}

// The loads of the coming point belong to the end of the step, t(n+1).
void Participant::advance() {
    const double to_s =
        static_cast<double>(session_.clock().step() + 1) * session_.clock().step_s();
    for (const auto& path : paths_) {
        or_diverged([&] { path->advance(to_s); });
        report_branch(*path, to_s);
    }
}

void Participant::report_branch(const LoadPath& path, double time_s) {
    const structure::Equilibrium& now = path.now();
    iterations_ += now.iterations;
    if (now.releases > 0) {
        session_.log(fmt::format(
            "body '{}' at {:.6g} s: the equilibrium could not be followed (a limit point "
            "or an instability); the body was released there and found another",
            path.body().name, time_s));
    }
    if (!now.resolved()) {
        session_.log(fmt::format("warning: {} ({:.6g} s, an error of {:.0f} %)",
                                 structure::unresolved_loads(path.body().name), time_s,
                                 100 * now.displacement_error));
    }
    if (now.negative_eigenvalues > 0) {
        session_.log(
            fmt::format("body '{}': this equilibrium is unstable ({} direction(s))",
                        path.body().name, now.negative_eigenvalues));
    }
}

bodies::NodalState Participant::state() const {
    bodies::NodalState all;
    for (const auto& path : paths_) {
        append(all, path->now().nodes_m, path->masses_kg());
    }
    return all;
}

void Participant::write_probes() {
    std::vector<bodies::BodyLoads> loads;
    for (const auto& path : paths_) loads.push_back(path->loads());
    const double time_s = session_.clock().time_s();
    probes_->row(time_s, probe_row_->values(time_s, state(), loads));
}

void Participant::write_fields() {
    const auto every = session_.clock().every(scene_.output.structure->every_s);
    files_->write(session_.clock().step() / every, session_.clock().time_s(), state());
}

void Participant::run() {
    session_.log(fmt::format("scene '{}': equilibria by Newton's method at {} points",
                             scene_.name, session_.clock().steps()));
    coupler::log_effects(session_);
    session_.log("each point: " + tasks_.names());
    if (probes_) write_probes();
    if (files_) write_fields();
    const auto trace = coupler::trace_of(session_, tasks_);
    while (!session_.clock().done()) tasks_.run();
    for (const auto& path : paths_) {
        if (path->unresolved())
            throw coupler::Diverged(structure::unresolved_loads(path->body().name));
    }
    finish(output::steady_seconds() - start_s_);
}

void Participant::finish(double wall_s) {
    auto report = coupler::basic_report(session_.world(), tasks_);
    output::StructureSummary structure;
    for (const auto& path : paths_)
        structure.elements +=
            static_cast<std::int64_t>(path->body().mesh.elements.size());
    structure.substeps = session_.clock().step();
    report.add(structure);
    progress_->finish(session_.clock().step());
    coupler::write_summary(session_, {&report, 1}, wall_s, probes_.get());
    session_.log(fmt::format(
        "done: {} equilibria, {} Newton steps in {:.1f} s; results in {}",
        session_.clock().step(), iterations_, wall_s, session_.out().string()));
}

}  // namespace
}  // namespace magfsi::equilibrium

int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(
        coupler::Role::structure,
        "Static equilibria of a magfsi scene, by Newton's method", argc, argv,
        [](const scene::Scene& scene, coupler::Session& session,
           const coupler::ParticipantArguments& arguments) {
            const auto& rest = scene.time.equilibrium;
            if (!rest || rest->method != scene::EquilibriumMethod::newton)
                throw std::invalid_argument(
                    "the scene asks for motion; start magfsi-structure for it");
            if (session.world().size() > 1)
                throw std::invalid_argument(
                    fmt::format("magfsi-equilibrium runs as one process, {} found; take "
                                "mpirun -n 1, or ./magfsi run SCENE",
                                session.world().size()));
            session.begin(scene::path_step_s(scene));
            equilibrium::Participant(scene, session, arguments.progress).run();
        });
}
