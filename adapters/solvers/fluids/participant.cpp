// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/fluids/participant.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupler/checkpoint/rank_rows.h"
#include "coupler/checkpoint/state_file.h"
#include "coupler/step/report.h"
#include "coupler/step/trace.h"

namespace magfsi::fluids {

#define MAGFSI_OUTPUT(name) extern const FluidOutput name##_output;
#include "adapters/solvers/fluids/outputs.inc"
#undef MAGFSI_OUTPUT

namespace {

// The outputs of this build, terminated by an entry without a name.
const FluidOutput* fluid_outputs() {
#define MAGFSI_OUTPUT(name) name##_output,
    static const FluidOutput registered[] = {
#include "adapters/solvers/fluids/outputs.inc"
        {}};
#undef MAGFSI_OUTPUT
    return registered;
}

}  // namespace

Participant::Participant(const scene::Scene& scene, coupler::Session& session,
                         FluidSolver& fluid, output::ProgressMode progress)
    : scene_(scene),
      session_(session),
      progress_mode_(progress),
      fluid_(fluid),
      run_{scene, session, fluid, nullptr} {
    if (session.world().coupled()) {
        coupling_ = coupler::make_fluid_coupling(session, fluid_);
        run_.balance = coupling_->balance();
    }
    if (session.restart()) restore(session_.open_restart());
    assemble();
}

// The audited sums belong to single ranks: a restart on another number of ranks gives all
// of them to rank 0.
void Participant::restore(const coupler::StateReader& file) {
    fluid_.restore(file);
    if (run_.balance && file.has("balance"))
        run_.balance->set(coupler::share_of(
            session_.world().local(), file.table("balance"), file.shape("balance")[0]));
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

void Participant::assemble_output() {
    outputs_.add(fluid_outputs(), run_, tasks_);
    outputs_.need(scene_.probes.has_value(), "probes");
    outputs_.need(scene_.output.fluid.has_value(), "fluid_fields");
    outputs_.need(scene_.checkpoint.has_value(), "checkpoint");
    if (!session_.world().leads()) return;
    progress_ = coupler::progress_on_stdout(session_, progress_mode_);
    tasks_.add_output("progress", [this] { progress_->update(session_.clock().step()); });
}

void Participant::run() {
    session_.log(fmt::format("scene '{}' to {:.6g} s in {} steps", scene_.name,
                             scene_.time.end_s, session_.clock().steps()));
    coupler::log_effects(session_);
    coupler::log_steps(
        session_, tasks_,
        fmt::format("fluid: {}, {} rank(s)", fluid_.headline(), session_.world().size()));
    if (coupling_) coupling_->begin();
    outputs_.begin();
    const auto trace = coupler::trace_of(session_, tasks_);
    const double start = output::steady_seconds();
    while (session_.running()) tasks_.run();
    finish(output::steady_seconds() - start);
}

// mlups counts all cell updates, those of repeated steps of the implicit scheme included.
coupler::ParticipantReport Participant::make_report() const {
    auto report =
        coupler::basic_report(session_.world(), tasks_, fluid_.waited_for_neighbours_s());
    output::FluidSummary fluid = fluid_.summary();
    report.load.max_ranks = static_cast<int>(
        std::max<std::int64_t>(1, fluid.cells / fluid_.min_cells_per_rank()));
    for (const auto& version : fluid_.versions()) report.versions.push_back(version);
    const std::int64_t advances =
        coupling_ ? coupling_->advances() : session_.clock().steps_here();
    const double advance_s = tasks_.seconds(coupler::advance_fluid);
    if (advances > 0) {
        fluid.mlups = 1e-6 * fluid.cells * static_cast<double>(advances) / advance_s;
    }
    report.add(fluid);
    return report;
}

void Participant::finish(double wall_s) {
    const auto report = make_report();
    if (session_.world().coupled()) return coupler::send_report(session_, report);
    if (!session_.world().leads()) return;
    outputs_.finish();
    progress_->finish(session_.clock().step());
    coupler::write_summary(session_, {&report, 1}, wall_s, outputs_.probes());
    session_.log(coupler::end_line(session_, wall_s));
}

}  // namespace magfsi::fluids
