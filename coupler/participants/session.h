// What both participants do alike before the first step: read the scene, meet the
// partner, agree, claim the run folder.
#pragma once

#include <spdlog/logger.h>
#include <memory>

#include "coupler/participants/guard.h"
#include "coupler/participants/handshake.h"
#include "coupler/step/clock.h"

namespace magfsi::coupler {

class Session {
  public:
    // Reads the scene named by the arguments into state, joins the world. Throws
    // SceneError, PartnerLost.
    Session(Role role, const ParticipantArguments& arguments, RunState& state);

    // step_s: the coupled step. Shakes hands, makes the run folder and, on the lead, its
    // log.
    void begin(double step_s);

    const World& world() const { return world_; }
    const scene::Scene& scene() const { return state_.scene; }
    const std::filesystem::path& out() const { return state_.out; }
    Clock& clock() { return *clock_; }
    const Clock& clock() const { return *clock_; }
    double timeout_s() const;

    // Writes to the lead's log; nothing elsewhere.
    void log(const std::string& line) const;
    spdlog::logger* logger() const { return logger_.get(); }

    // Ends a step: counts it, and throws Stopped when a signal came.
    void complete_step();

  private:
    RunState& state_;
    World world_;
    std::unique_ptr<Clock> clock_;
    std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace magfsi::coupler
