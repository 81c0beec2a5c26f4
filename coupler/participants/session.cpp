#include "coupler/participants/session.h"

#include <fmt/format.h>

#include <cmath>

#include "coupler/checkpoint/restart.h"
#include "coupler/output/log.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

namespace {

RunState& fill(RunState& state, const ParticipantArguments& arguments, RunPlan plan) {
    state.plan = std::move(plan);
    state.out = arguments.out.empty() ? default_out(state.plan.name) : arguments.out;
    return state;
}

}  // namespace

Session::Session(Role role, const ParticipantArguments& arguments, RunPlan plan,
                 RunState& state)
    : state_(fill(state, arguments, std::move(plan))),
      restart_wanted_(arguments.restart),
      notes_(arguments.notes),
      world_(role, state_.plan.roles.size() == 2) {}

double Session::timeout_s() const {
    return plan().coupling ? plan().coupling->timeout_s : startup_timeout_s;
}

void Session::begin(double step_s) {
    clock_ = std::make_unique<Clock>(step_s, plan().end_s);
    if (!restart_wanted_.empty()) find_restart(step_s);
    if (world_.coupled()) {
        Agreement mine;
        mine.scene_hash = plan().scene_hash;
        mine.steps = clock_->steps();
        mine.step_ps = std::llround(step_s * 1e12);
        mine.first_step = clock_->first_step();
        shake_hands(world_, mine, startup_timeout_s);
    }
    claim_run_folder();
    for (const std::string& note : notes_) log(note);
    if (!restart_) return;
    for (const std::string& fault : restart_->skipped) log("skipped: " + fault);
    log(fmt::format("restart at step {}, t = {:.6g} s", clock_->step(),
                    clock_->time_s()));
}

void Session::find_restart(double step_s) {
    restart_.emplace();
    if (world_.root())
        restart_ = coupler::find_restart(restart_wanted_, state_.out, plan());
    restart_->folder = restart_folder(restart_wanted_, state_.out);
    StateHeader& header = restart_->header;
    MPI_Bcast(&header, sizeof header, MPI_BYTE, 0, world_.local());
    const std::int64_t ratio = header.steps_in_one(step_s);
    const bool retried = plan().checkpoint && plan().checkpoint->retry;
    if (ratio == 0 || (ratio > 1 && !retried)) {
        throw std::invalid_argument(
            fmt::format("--restart: the checkpoint in {} has coupled steps of {:.17g} s, "
                        "this run of {:.17g} s; set time.step to the former",
                        restart_->folder.string(), header.step_s, step_s));
    }
    clock_->start_at(ratio * header.step);
    state_.step = clock_->step();
    state_.time_s = clock_->time_s();
}

void Session::claim_run_folder() {
    if (world_.root()) std::filesystem::create_directories(state_.out / "fields");
    if (world_.leads()) {
        std::filesystem::remove(state_.out / "summary.json");
        std::error_code none;  // false where one of them is not there
        const bool goes_on =
            restart_ && std::filesystem::equivalent(restart_->folder, state_.out, none);
        // Those of another run, or of steps that this one is about to do again.
        clear_checkpoints_after(state_.out, goes_on ? restart_->header.step : -1);
    }
    MPI_Barrier(world_.local());
    state_.started = true;
    if (!world_.leads()) return;
    const auto mode = restart_ ? output::LogMode::append : output::LogMode::anew;
    logger_ = output::open_log(state_.out / "run.log", "magfsi", mode);
}

void Session::log(const std::string& line) const {
    if (logger_) logger_->info(line);
}

void Session::complete_step() {
    clock_->tick();
    state_.step = clock_->step();
    state_.time_s = clock_->time_s();
    if (stop_requested() != 0 && !stop_postponed()) {
        throw Stopped(fmt::format("told to end by signal {}", stop_requested()));
    }
}

}  // namespace magfsi::coupler
