// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/participants/session.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "coupler/checkpoint/restart.h"
#include "coupler/output/file.h"
#include "coupler/output/log.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/handshake.h"
#include "coupler/participants/waiting.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

output::Named<std::string> versions() {
    std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
    int length = 0;
    MPI_Get_library_version(text.data(), &length);
    const std::string mpi(text.data());
    output::Named<std::string> found{{"magfsi", MAGFSI_VERSION},
                                     {"MPI", mpi.substr(0, mpi.find(','))}};
    // The commit of a checkout, which its launcher passes in the environment.
    if (const char* const commit = std::getenv("MAGFSI_COMMIT"); commit && *commit)
        found.insert(found.begin() + 1, {"commit", commit});
    return found;
}

namespace {

// Fills the state before the members that need it are made.
RunState& fill(RunState& state, const ParticipantArguments& arguments, RunPlan plan) {
    state.plan = std::move(plan);
    state.out = arguments.out.empty() ? default_out(state.plan.name) : arguments.out;
    return state;
}

}  // namespace

Session::Session(Role role, const ParticipantArguments& arguments, RunPlan plan,
                 RunState& state)
    : state_(fill(state, arguments, std::move(plan))),
      arguments_(arguments),
      world_(role, state_.plan.roles.size() == 2, state_.plan.scene_hash,
             state_.plan.controlled) {}

double Session::timeout_s() const {
    return plan().coupling ? plan().coupling->timeout_s.value_or(no_timeout_s)
                           : no_timeout_s;
}

void Session::begin(double step_s) {
    clock_ = std::make_unique<Clock>(step_s, plan().end_s, plan().steps_at_a_time);
    if (!arguments_.restart.empty()) find_restart(step_s);
    if (world_.coupled()) {
        Agreement mine;
        mine.scene_hash = plan().scene_hash;
        mine.steps = clock_->steps();
        mine.step_ps = std::llround(step_s * 1e12);
        mine.first_step = clock_->first_step();
        shake_hands(world_, mine, no_timeout_s);
    }
    claim_run_folder();
    for (const std::string& note : arguments_.notes) log(note);
    if (!earlier_results_.empty())
        log(fmt::format("the results of an earlier run are now in {}",
                        earlier_results_.string()));
    if (!restart_) return;
    for (const std::string& fault : restart_->skipped) log("skipped: " + fault);
    log(fmt::format("restart at step {}, t = {:.6g} s", clock_->step(),
                    clock_->time_s()));
}

void Session::find_restart(double step_s) {
    restart_.emplace();
    if (world_.root())
        restart_ = coupler::find_restart(arguments_.restart, state_.out, plan());
    restart_->folder = restart_folder(arguments_.restart, state_.out);
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

StateReader Session::open_restart() const {
    return StateReader(
        checkpoint_file(restart_->folder, restart_->header.step, world_.self()));
}

void Session::claim_run_folder() {
    std::error_code none;  // then false if one of the folders does not exist
    const bool goes_on =
        restart_ && std::filesystem::equivalent(restart_->folder, state_.out, none);
    if (world_.leads()) take_over(goes_on);
    // The exchange makes all ranks wait until the folder is this run's.
    const char mine = 1;
    char theirs = 0;
    if (world_.coupled())
        swap_with_partner(world_, &mine, 1, &theirs, 1, no_timeout_s, "run folder");
    else
        MPI_Barrier(world_.local());
    if (!world_.leads())
        state_.lock = std::make_unique<output::FolderLock>(
            state_.out, output::FolderLock::Holder::member, 0);
    state_.started = true;
    open_log();
}

void Session::open_log() {
    const auto file = state_.out / "run.log";
    if (world_.leads()) {
        const auto mode = restart_ ? output::LogMode::append : output::LogMode::anew;
        logger_ = output::open_log(file, "magfsi", mode);
        if (!state_.lock->held())
            log("warning: the run folder's file system has no locks; see that no other "
                "run uses it");
    }
    if (!world_.root()) return;
    tell_of_long_waits([logger = logger_, file](const std::string& line) {
        (logger ? logger : output::open_log(file, "magfsi", output::LogMode::append))
            ->info(line);
    });
}

void Session::take_over(bool goes_on) {
    using output::FolderLock;
    std::filesystem::create_directories(state_.out);
    state_.lock = std::make_unique<FolderLock>(state_.out, FolderLock::Holder::leader,
                                               output::patience_with_the_ending_s);
    state_.lock->sign("an MPI job");
    if (goes_on) {
        output::refuse_links(state_.out, plan().solver_folders);
        std::filesystem::remove(state_.out / "summary.json");
        // Checkpoints of steps that this run will do again.
        clear_checkpoints_after(state_.out, restart_->header.step);
    } else {
        earlier_results_ =
            output::set_aside(state_.out, plan().solver_folders, arguments_.overwrite);
    }
    std::filesystem::create_directories(state_.out / "fields");
    record_run(goes_on);
}

// A run that goes on may have been given the folder's own scene.yaml, not the first.
void Session::keep(const KeptInput& input, bool goes_on) const {
    const auto given = state_.out / "scene_as_given.yaml";
    if (!input.as_given.empty() && !(goes_on && std::filesystem::exists(given)))
        output::write_atomically(given, input.as_given);
    output::write_atomically(state_.out / "scene.yaml", input.scene);
    output::write_atomically(state_.out / "scene.json", input.as_read);
    for (const auto& [file, name] : input.files)
        output::copy_atomically(file, state_.out / name);
}

void Session::record_run(bool goes_on) const {
    if (plan().input) keep(plan().input(), goes_on);
    output::RunRecord record;
    record.scene = arguments_.scene.string();
    record.command = arguments_.command;
    record.overrides = arguments_.overrides;
    record.restart = arguments_.restart;
    record.machine = plan().machine;
    record.versions = versions();
    record.ranks.emplace_back(to_string(world_.self()), world_.size());
    if (world_.coupled())
        record.ranks.emplace_back(to_string(world_.other()), world_.partner_size());
    output::add_record(state_.out / "run.json", record, goes_on);
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
