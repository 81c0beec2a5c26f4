// SPDX-License-Identifier: GPL-2.0-or-later
// One participant's part in a run: its partner, the plan, the clock, the run folder and
// the checkpoint that it continues. All participants start alike: they find each other,
// check that they agree, and take over the run folder.
#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <optional>

#include "coupler/checkpoint/restart.h"
#include "coupler/participants/guard.h"
#include "coupler/participants/world.h"
#include "coupler/step/clock.h"

namespace magfsi::coupler {

// Versions of this program and of the libraries that both sides use.
output::Named<std::string> versions();

// The frame in which a participant runs; calls are made by all its ranks.
class Session {
  public:
    // Joins the partner's processes (World). Writes plan and run folder into `state`,
    // from which the guard reports a failure. arguments and state must outlive this
    // object. Throws PartnerLost.
    Session(Role role, const ParticipantArguments& arguments, RunPlan plan,
            RunState& state);

    // Prepares the run with a coupled step of step_s [s]: reads the header of the
    // checkpoint that the user asked for, compares scene and steps with the partner, and
    // makes the run folder; the leading process (World::leads) opens the log. Throws
    // std::invalid_argument for a checkpoint that this run cannot continue, PartnerLost
    // if the two sides differ, output::FolderTaken if another run owns the folder.
    // Collective over both sides.
    void begin(double step_s);

    const World& world() const { return world_; }
    const RunState& state() const { return state_; }
    const RunPlan& plan() const { return state_.plan; }
    const std::filesystem::path& out() const { return state_.out; }
    // The clock exists from begin() on.
    Clock& clock() { return *clock_; }
    const Clock& clock() const { return *clock_; }
    // Longest wait for the partner [s], infinite unless the scene sets it.
    double timeout_s() const;
    // True if the user asked for a trace of the tasks.
    bool traced() const { return arguments_.trace; }

    // The checkpoint that this run continues; null for a run that starts at time 0.
    const RestartPoint* restart() const { return restart_ ? &*restart_ : nullptr; }
    // Opens this participant's file of that checkpoint; restart() must not be null.
    // Throws StateFault.
    StateReader open_restart() const;

    // Ends the run after the present step, with all its files complete; the summary names
    // the cause. Must be called on all ranks of both sides at the same step.
    void stop(const std::string& cause) { stop_cause_ = cause; }
    const std::optional<std::string>& stop_cause() const { return stop_cause_; }
    bool running() const { return !clock_->done() && !stop_cause_; }

    // Writes a line to run.log on the leading process; does nothing on the others.
    void log(const std::string& line) const;
    spdlog::logger* logger() const { return logger_.get(); }

    // Ends a coupled step: advances the clock. Throws Stopped after a signal to end,
    // unless checkpoints answer it (postpone_stop).
    void complete_step();

  private:
    // Finds the checkpoint and sets the clock to it; the root reads, the others get the
    // header.
    void find_restart(double step_s);
    // Makes the run folder this run's; the partner and the other ranks wait for that.
    void claim_run_folder();
    // Locks the folder and clears it for this run. Leading process only.
    void take_over(bool goes_on);
    // Writes the scene's texts and the entry in run.json.
    void keep(const KeptInput& input, bool goes_on) const;
    void record_run(bool goes_on) const;
    void open_log();

    RunState& state_;
    const ParticipantArguments& arguments_;
    std::filesystem::path earlier_results_;  // new place of results that were set aside
    World world_;
    std::unique_ptr<Clock> clock_;
    std::optional<RestartPoint> restart_;
    std::optional<std::string> stop_cause_;
    std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace magfsi::coupler
