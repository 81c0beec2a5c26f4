// SPDX-License-Identifier: GPL-2.0-or-later
// One participant's part in a run: its partner, the plan, the clock, the run folder and
// the checkpoint to go on from. Both participants start alike: they find each other,
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

// Of this program and of the libraries that both sides have.
output::Named<std::string> versions();

class Session {
  public:
    // Joins the partner's processes (World). Writes plan and run folder into `state`,
    // from which the guard reports a run that fails. Throws PartnerLost.
    Session(Role role, const ParticipantArguments& arguments, RunPlan plan,
            RunState& state);

    // step_s: the coupled time step. Reads the header of the checkpoint that the user
    // asked for, compares scene and steps with the partner, and makes the run folder; the
    // leading process (World::leads) opens the log. Throws std::invalid_argument on a
    // checkpoint that this run cannot continue, PartnerLost where the two sides differ.
    void begin(double step_s);

    const World& world() const { return world_; }
    const RunState& state() const { return state_; }
    const RunPlan& plan() const { return state_.plan; }
    const std::filesystem::path& out() const { return state_.out; }
    Clock& clock() { return *clock_; }
    const Clock& clock() const { return *clock_; }
    double timeout_s() const;
    bool traced() const { return arguments_.trace; }

    // The checkpoint that this run continues; null for a run from time 0.
    const RestartPoint* restart() const { return restart_ ? &*restart_ : nullptr; }

    // Ends the run after this step, with all its files complete; the summary names the
    // cause.
    void stop(const std::string& cause) { stop_cause_ = cause; }
    const std::optional<std::string>& stop_cause() const { return stop_cause_; }
    bool running() const { return !clock_->done() && !stop_cause_; }

    // Writes a line to run.log, on the leading process; does nothing on the others.
    void log(const std::string& line) const;
    spdlog::logger* logger() const { return logger_.get(); }

    // At the end of each coupled step: advances the clock. Throws Stopped after a signal
    // to end, unless checkpoints answer it (postpone_stop).
    void complete_step();

  private:
    void find_restart(double step_s);
    void claim_run_folder();
    void take_over(bool goes_on);
    void record_run(bool goes_on) const;
    void open_log();

    RunState& state_;
    const ParticipantArguments& arguments_;
    std::filesystem::path earlier_results_;  // set aside
    World world_;
    std::unique_ptr<Clock> clock_;
    std::optional<RestartPoint> restart_;
    std::optional<std::string> stop_cause_;
    std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace magfsi::coupler
