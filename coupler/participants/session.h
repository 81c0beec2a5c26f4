// What both participants do alike before the first step: find the partner, agree with it,
// claim the run folder.
#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <optional>

#include "coupler/checkpoint/restart.h"
#include "coupler/participants/guard.h"
#include "coupler/participants/world.h"
#include "coupler/step/clock.h"

namespace magfsi::coupler {

class Session {
  public:
    // Puts plan and run folder into state and joins the world. Throws PartnerLost.
    Session(Role role, const ParticipantArguments& arguments, RunPlan plan,
            RunState& state);

    // step_s: the coupled step. Finds the checkpoint that was asked for, shakes hands,
    // makes the run folder and, on the lead, its log. Throws std::invalid_argument on a
    // checkpoint that this run cannot go on from.
    void begin(double step_s);

    const World& world() const { return world_; }
    const RunPlan& plan() const { return state_.plan; }
    const std::filesystem::path& out() const { return state_.out; }
    Clock& clock() { return *clock_; }
    const Clock& clock() const { return *clock_; }
    double timeout_s() const;

    // The checkpoint that this run goes on from; null when it starts anew.
    const RestartPoint* restart() const { return restart_ ? &*restart_ : nullptr; }

    // Ends the step loop in order; the summary names the cause.
    void stop(const std::string& cause) { stop_cause_ = cause; }
    const std::optional<std::string>& stop_cause() const { return stop_cause_; }
    bool running() const { return !clock_->done() && !stop_cause_; }

    // Writes to the lead's log; nothing elsewhere.
    void log(const std::string& line) const;
    spdlog::logger* logger() const { return logger_.get(); }

    // Ends a step: counts it, and throws Stopped when a signal came that the
    // scene has no checkpoint for.
    void complete_step();

  private:
    void find_restart(double step_s);
    void claim_run_folder();

    RunState& state_;
    std::string restart_wanted_;
    std::vector<std::string> notes_;
    World world_;
    std::unique_ptr<Clock> clock_;
    std::optional<RestartPoint> restart_;
    std::optional<std::string> stop_cause_;
    std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace magfsi::coupler
