// SPDX-License-Identifier: GPL-2.0-or-later
// The structure's link to a controller: a user's program in a process of its own
// (adapters/python/magfsi/controller.py). It is asked at some steps, answers with a text,
// and has a state that checkpoints contain. All calls are collective over the structure;
// its root exchanges the messages.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupler/participants/world.h"

namespace magfsi::coupler {

// The controller of a scene.
struct ControlPlan {
    // Path of the user's script.
    std::string script;
    std::vector<std::string> probes;  // names that the script uses
    // Interval between two questions [s], and the longest wait for an answer [s].
    double every_s = 0;
    double timeout_s = 0;
};

// The structure's end of the exchange with the controller.
class Controller {
  public:
    // Loads the script and restores the state, one that keep() returned before, if it is
    // given. out: the run folder. keeps: true if checkpoints will ask for the state,
    // which the script must then be able to give. Throws std::runtime_error with the
    // controller's traceback if it fails or hangs, PartnerLost if it is gone; so do all
    // other calls.
    Controller(const World& world, const ControlPlan& plan, const std::string& out,
               bool keeps, std::optional<std::vector<double>> state);

    // Ends the controller's process; called after the last step.
    void end();

    // The controller's answer to the values of the probes at time_s [s], the same text on
    // all ranks.
    std::string ask(std::int64_t step, double time_s, std::span<const double> probes);

    // The controller's state on the root, one byte per number; empty on the other ranks.
    std::vector<double> keep();

  private:
    enum class Request : char;
    // Sends a request and returns its answer; `what` names the awaited answer in
    // messages.
    std::string request(Request kind, std::string_view content, const std::string& what);
    std::string answer(const std::string& what);
    // Reports a controller that does not answer, with the place where it hangs.
    [[noreturn]] void fail_late(const std::string& what) const;

    const World& world_;
    ControlPlan plan_;
    // Path of a file in which a controller that hangs leaves its place in the script.
    std::string trace_;
};

}  // namespace magfsi::coupler
