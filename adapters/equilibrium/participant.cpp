#include "adapters/equilibrium/participant.h"

#include <fmt/format.h>

#include "coupler/participants/errors.h"
#include "coupler/step/log_head.h"
#include "coupler/step/progress_line.h"
#include "coupler/step/report.h"

namespace magfsi::equilibrium {

namespace {

template <class Work>
void or_diverged(const Work& work) {
    try {
        work();
    } catch (const std::runtime_error& fault) {
        throw coupler::Diverged(fault.what());
    }
}

}  // namespace

Participant::Participant(const scene::Scene& scene, coupler::Session& session,
                         output::ProgressMode progress)
    : scene_(scene), session_(session) {
    std::vector<structure::Body> solids;
    bodies::NodalState start;
    for (const scene::Body& body : scene.bodies) {
        or_diverged([&] { paths_.push_back(std::make_unique<LoadPath>(scene, body)); });
        const LoadPath& path = *paths_.back();
        report_branch(path);
        solids.push_back(path.body());
        start.position_m.insert(start.position_m.end(), path.placed_m().begin(),
                                path.placed_m().end());
        start.mass_kg.insert(start.mass_kg.end(), path.masses_kg().begin(),
                             path.masses_kg().end());
    }
    start.velocity_m_s.resize(start.position_m.size());
    if (scene.probes) {
        probe_row_ = std::make_unique<bodies::ProbeRow>(scene, solids, start);
        probes_ = std::make_unique<output::ProbeFile>(session.out() / "probes.csv",
                                                      probe_row_->columns());
    }
    if (scene.output.structure)
        files_ = std::make_unique<bodies::StructureFiles>(solids, start, session.out());
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

void Participant::advance() {
    const double to_s =
        static_cast<double>(session_.clock().step() + 1) * session_.clock().step_s();
    for (const auto& path : paths_) {
        or_diverged([&] { path->advance(to_s); });
        report_branch(*path);
    }
}

void Participant::report_branch(const LoadPath& path) {
    const structure::Equilibrium& now = path.now();
    iterations_ += now.iterations;
    if (now.releases > 0) {
        session_.log(fmt::format(
            "body '{}' at {:.6g} s: the equilibrium could not be followed (a limit point "
            "or an instability); the body was released there and found another",
            path.body().name, session_.clock().time_s() + session_.clock().step_s()));
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
        const auto& nodes = path->now().nodes_m;
        all.position_m.insert(all.position_m.end(), nodes.begin(), nodes.end());
        all.mass_kg.insert(all.mass_kg.end(), path->masses_kg().begin(),
                           path->masses_kg().end());
    }
    all.velocity_m_s.resize(all.position_m.size());
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
    while (!session_.clock().done()) tasks_.run();
    finish(output::steady_seconds() - start_s_);
}

void Participant::finish(double wall_s) {
    auto report = coupler::basic_report(session_.world(), tasks_);
    output::StructureSummary structure;
    for (const auto& path : paths_)
        structure.elements +=
            static_cast<std::int64_t>(path->body().mesh.elements.size());
    report.structure = structure;
    progress_->finish(session_.clock().step());
    coupler::write_summary(session_, {&report, 1}, wall_s, probes_.get());
    session_.log(fmt::format(
        "done: {} equilibria, {} Newton steps in {:.1f} s; results in {}",
        session_.clock().step(), iterations_, wall_s, session_.out().string()));
}

}  // namespace magfsi::equilibrium
