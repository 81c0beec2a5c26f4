// SPDX-License-Identifier: GPL-2.0-or-later
// The structure's link to a controller: a program of the user's in a process of its own
// (adapters/python/magfsi/controller.py), which is asked at some steps, answers with a
// text, and has a state that checkpoints keep. All calls are collective over the
// structure; its root talks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupler/participants/world.h"

namespace magfsi::coupler {

struct ControlPlan {
    std::string script;
    std::vector<std::string> probes;  // by the names that the script gives them
    double every_s = 0;
    double timeout_s = 0;  // longest wait for an answer
};

class Controller {
  public:
    // The script is loaded; it goes on from a state that keep() gave, where there is one.
    // keeps: whether there will be checkpoints, which it must then be able to serve.
    // Throws std::runtime_error, as the calls below do, with the controller's traceback
    // where it fails or hangs; PartnerLost where it is gone.
    Controller(const World& world, const ControlPlan& plan, const std::string& out,
               bool keeps, std::optional<std::vector<double>> state);

    // After the last step: the process ends.
    void end();

    // What it answers to these probes, on all ranks.
    std::string ask(std::int64_t step, double time_s, std::span<const double> probes);

    // Its state, bytes as numbers, on the root.
    std::vector<double> keep();

  private:
    enum class Request : char;
    std::string request(Request kind, std::string_view content, const std::string& what);
    std::string answer(const std::string& what);
    [[noreturn]] void fail_late(const std::string& what) const;

    const World& world_;
    ControlPlan plan_;
    std::string trace_;  // a file in which a controller that hangs leaves where it is
};

}  // namespace magfsi::coupler
