#include "adapters/fluids/participant.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupler/checkpoint/open_restart.h"
#include "coupler/step/log_head.h"
#include "coupler/step/probe_columns.h"
#include "coupler/step/progress_line.h"
#include "coupler/step/report.h"

namespace magfsi::fluids {

Participant::Participant(coupler::Session& session, FluidSolver& fluid,
                         output::ProgressMode progress)
    : session_(session), progress_mode_(progress), fluid_(fluid) {
    if (session.world().coupled())
        coupling_ = std::make_unique<coupler::FluidCoupling>(session, fluid_);
    if (session.restart()) fluid_.restore(coupler::open_restart(session_), balance());
    assemble();
}

void Participant::assemble() {
    if (coupling_) {
        coupling_->add_tasks(tasks_);
    } else {
        tasks_.add(coupler::advance_fluid, [this] { fluid_.advance(); });
        tasks_.add("count step", [this] { session_.complete_step(); });
    }
    tasks_.add("check divergence", [this] { fluid_.check_divergence(); });
    assemble_output();
}

coupler::BalanceRecord* Participant::balance() const {
    return coupling_ ? coupling_->balance() : nullptr;
}

void Participant::assemble_output() {
    const scene::Scene& scene = session_.scene();
    const bool leads = session_.world().leads();
    writes_probes_ =
        scene.probes && (balance() || !coupler::fluid_columns(scene).empty());
    if (writes_probes_) {
        if (leads) {
            probes_ = coupler::open_probes(session_, coupler::fluid_columns(scene));
        }
        tasks_.add_output("probes",
                          [this, every = session_.clock().every(scene.probes->every_s)] {
                              if (session_.clock().step() % every == 0) write_probes();
                          });
    }
    if (scene.output.fluid) {
        files_ = std::make_unique<FluidFiles>(session_.world(), fluid_,
                                              *scene.output.fluid, session_.out());
        if (session_.restart()) {
            files_->resume(session_.clock(),
                           session_.clock().every(scene.output.fluid->every_s));
        }
        tasks_.add_output(
            "write fields",
            [this, every = session_.clock().every(scene.output.fluid->every_s)] {
                const auto step = session_.clock().step();
                if (step % every == 0)
                    files_->write(step / every, session_.clock().time_s());
            });
    }
    if (scene.checkpoint) assemble_checkpoint();
    if (leads) {
        progress_ = coupler::progress_on_stdout(session_, progress_mode_);
        tasks_.add_output("progress",
                          [this] { progress_->update(session_.clock().step()); });
    }
}

void Participant::assemble_checkpoint() {
    checkpoints_ = std::make_unique<coupler::Checkpoints>(
        session_, [this](coupler::StateWriter* file) { fluid_.save(balance(), file); });
    tasks_.add_output("checkpoint", [this] { checkpoints_->end_step(); });
}

void Participant::write_probes() {
    std::vector<double> numbers = fluid_.probe_values(session_.scene());
    if (!session_.world().coupled()) {
        if (probes_) probes_->row(session_.clock().time_s(), numbers);
        return;
    }
    if (balance()) {
        const auto received = balance()->collect(session_.world().local());
        numbers.insert(numbers.end(), received.begin(), received.end());
    }
    if (session_.world().root()) {
        coupler::send_numbers(session_.world(), session_.clock().step(), numbers,
                              session_.timeout_s());
    }
}

void Participant::run() {
    session_.log(fmt::format("scene '{}' to {:.6g} s in {} steps", session_.scene().name,
                             session_.scene().time.end_s, session_.clock().steps()));
    coupler::log_effects(session_);
    coupler::log_steps(
        session_, tasks_,
        fmt::format("fluid: {}, {} rank(s)", fluid_.headline(), session_.world().size()));
    if (coupling_) coupling_->begin();
    if (!session_.restart()) {
        if (writes_probes_) write_probes();
        if (files_) files_->write(0, 0);
    }
    const double start = output::steady_seconds();
    while (session_.running()) tasks_.run();
    finish(output::steady_seconds() - start);
}

coupler::ParticipantReport Participant::make_report(double wall_s) const {
    auto report =
        coupler::basic_report(session_.world(), tasks_, fluid_.waited_for_neighbors_s());
    output::FluidSummary fluid = fluid_.summary();
    report.load.most_ranks = static_cast<int>(
        std::max<std::int64_t>(1, fluid.cells / fluid_.fewest_cells_a_rank()));
    for (const auto& version : fluid_.versions()) report.versions.push_back(version);
    double advance_s = wall_s;
    for (const auto& [task, seconds] : tasks_.timer().seconds()) {
        if (task == coupler::advance_fluid) advance_s = seconds;
    }
    const std::int64_t advances =
        coupling_ ? coupling_->advances() : session_.clock().steps_here();
    if (advances > 0) {
        fluid.mlups = 1e-6 * static_cast<double>(fluid.cells) *
                      static_cast<double>(advances) / advance_s;
    }
    report.fluid = fluid;
    return report;
}

void Participant::finish(double wall_s) {
    const auto report = make_report(wall_s);
    if (session_.world().coupled()) {
        coupler::swap_text(session_.world(), coupler::to_text(report),
                           session_.timeout_s(), "final report");
        return;
    }
    if (!session_.world().leads()) return;
    if (checkpoints_) checkpoints_->finish();
    progress_->finish(session_.clock().step());
    coupler::write_summary(session_, {&report, 1}, wall_s, probes_.get());
    session_.log(coupler::end_line(session_, wall_s));
}

}  // namespace magfsi::fluids
