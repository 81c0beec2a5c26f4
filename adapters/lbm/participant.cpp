#include "adapters/lbm/participant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "adapters/lbm/fluid_probes.h"
#include "adapters/lbm/fluid_state.h"
#include "adapters/lbm/scene_to_fluid.h"
#include "coupler/immersed_boundary/grid_text.h"
#include "coupler/immersed_boundary/kernel_choice.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/wait.h"
#include "coupler/scene/effective.h"
#include "coupler/step/probe_columns.h"
#include "coupler/step/progress_line.h"
#include "coupler/step/report.h"

namespace magfsi::lbm {

namespace {

constexpr const char* advance_task = "advance fluid";

}  // namespace

Participant::Participant(coupler::Session& session, output::ProgressMode progress)
    : session_(session),
      progress_mode_(progress),
      fluid_(session.world().local(),
             to_config(*session.scene().fluid, session.clock().step_s())),
      lbm_(fluid_) {
    if (session.world().coupled()) join_structure();
    if (session.restart()) restore();
    assemble();
}

void Participant::join_structure() {
    const scene::Coupling& coupling = *session_.scene().coupling;
    exchange_ =
        std::make_unique<coupler::FluidExchange>(session_.world(), session_.timeout_s());
    immersed_boundary_ = std::make_unique<coupler::FluidSide>(
        lbm_,
        lbm_.grid().owned_by_rank[static_cast<std::size_t>(session_.world().rank())],
        coupler::to_kernel(coupling.immersed_boundary.kernel), session_.clock().step_s());
    if (session_.scene().probes && session_.scene().probes->interface_balance) {
        balance_ = std::make_unique<coupler::BalanceRecord>();
    }
    coupler::swap_text(session_.world(), coupler::to_text(lbm_.grid()),
                       coupler::startup_timeout_s, "description of the grid");
}

void Participant::assemble() {
    const bool at_once =
        exchange_ && session_.scene().coupling->scheme == scene::Scheme::parallel;
    if (exchange_ && !at_once) assemble_turn();
    tasks_.add(advance_task, [this] { lbm_.advance(); });
    tasks_.add("count step", [this] { session_.complete_step(); });
    if (at_once) assemble_meeting();
    if (exchange_ && !at_once) {
        tasks_.add_coupling("sample velocities", [this] {
            exchange_->send(session_.clock().step() - 1,
                            immersed_boundary_->sample(batch_->now_m));
        });
    }
    tasks_.add("check divergence", [this] { check_divergence(); });
    assemble_output();
}

// Serial: the impulses of the structure's step act in the same step of the fluid.
void Participant::assemble_turn() {
    tasks_.add_coupling("wait for structure", [this] {
        batch_ = &exchange_->receive(session_.clock().step());
    });
    tasks_.add_coupling("spread impulses", [this] {
        immersed_boundary_->spread(batch_->before_m, batch_->impulse);
    });
    if (balance_) {
        tasks_.add_coupling("audit interface",
                            [this] { balance_->add(immersed_boundary_->received()); });
    }
}

// Parallel: both have done step n. The impulses of the structure's step act in the
// fluid's coming step; the U that the structure gets has half of their effect.
void Participant::assemble_meeting() {
    tasks_.add_coupling("wait for structure", [this] {
        batch_ = &exchange_->receive(session_.clock().step() - 1);
    });
    tasks_.add_coupling("spread impulses", [this] {
        immersed_boundary_->spread(batch_->before_m, batch_->impulse);
    });
    if (balance_) {
        tasks_.add_coupling("audit interface", [this] {
            balance_->add(
                immersed_boundary_->received(immersed_boundary_->sampled_cells()));
        });
    }
    tasks_.add_coupling("sample velocities", [this] {
        exchange_->send(session_.clock().step() - 1,
                        immersed_boundary_->sample_forced(
                            batch_->now_m, session_.scene().fluid->density_kg_m3));
        exchange_->finish_sending();
    });
}

void Participant::assemble_output() {
    const scene::Scene& scene = session_.scene();
    const bool leads = session_.world().leads();
    writes_probes_ = scene.probes && (balance_ || !scene.probes->fluid.empty());
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
        files_ = std::make_unique<FluidFiles>(session_.world().local(), fluid_,
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
        session_, [this](coupler::StateWriter* file) {
            save_fluid(session_.world().local(), fluid_, balance_.get(), file);
        });
    tasks_.add_output("checkpoint", [this] { checkpoints_->end_step(); });
}

void Participant::restore() {
    restore_fluid(session_.world().local(), coupler::open_restart(session_), fluid_,
                  balance_.get());
}

// The velocities at the first positions, so that step 0 of the structure can start.
void Participant::begin_coupling() {
    batch_ = &exchange_->receive(-1);
    exchange_->send(-1, immersed_boundary_->sample(batch_->now_m));
}

void Participant::write_probes() {
    std::vector<double> numbers = probe_values(session_.scene(), fluid_);
    if (!session_.world().coupled()) {
        if (probes_) probes_->row(session_.clock().time_s(), numbers);
        return;
    }
    if (balance_) {
        const auto received = balance_->collect(session_.world().local());
        numbers.insert(numbers.end(), received.begin(), received.end());
    }
    if (session_.world().root()) {
        coupler::send_numbers(session_.world(), session_.clock().step(), numbers,
                              session_.timeout_s());
    }
}

void Participant::check_divergence() {
    const auto fault = fluid_.diverged();
    if (fault) throw coupler::Diverged(fluid::to_string(*fault));
}

void Participant::run() {
    if (session_.world().root()) {
        const auto& c = fluid_.config();
        fmt::print(
            "fluid: {} x {} x {} cells of {:.4g} mm, step {:.4g} us, relaxation time "
            "{:.5g}, {} collision, {} kernels, {} rank(s)\nfluid step: {}\n",
            c.cells[0], c.cells[1], c.cells[2], c.spacing_m * 1e3, c.time_step_s * 1e6,
            fluid_.relaxation_time(), fluid::to_string(fluid_.collision()),
            fluid_.kernel(), session_.world().size(), tasks_.names());
        std::fflush(stdout);
    }
    session_.log(fmt::format("scene '{}': {} to {:.6g} s in {} steps",
                             session_.scene().name,
                             fmt::join(scene::active_effects(session_.scene()), ", "),
                             session_.scene().time.end_s, session_.clock().steps()));
    session_.log(fmt::format("absent: {}",
                             fmt::join(scene::absent_effects(session_.scene()), ", ")));
    if (exchange_) begin_coupling();
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
    const auto& n = fluid_.config().cells;
    output::FluidSummary fluid;
    fluid.cells = static_cast<std::int64_t>(n[0]) * n[1] * n[2];
    constexpr std::int64_t fewest_cells_a_rank = 20000;
    report.load.most_ranks =
        static_cast<int>(std::max<std::int64_t>(1, fluid.cells / fewest_cells_a_rank));
    double advance_s = wall_s;
    for (const auto& [task, seconds] : tasks_.timer().seconds()) {
        if (task == advance_task) advance_s = seconds;
    }
    if (session_.clock().steps_here() > 0) {
        fluid.mlups = 1e-6 * static_cast<double>(fluid.cells) *
                      static_cast<double>(session_.clock().steps_here()) / advance_s;
    }
    fluid.relaxation_time = fluid_.relaxation_time();
    fluid.spacing_m = fluid_.config().spacing_m;
    fluid.collision = fluid::to_string(fluid_.collision());
    fluid.kernel = fluid_.kernel();
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

}  // namespace magfsi::lbm
