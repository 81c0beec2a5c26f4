// SPDX-License-Identifier: GPL-2.0-or-later
// How nodes are slowed beside all that acts on them: the option and its law. A new law is
// a member and its share here, and a key of the scene.
#pragma once

#include <array>
#include <cmath>

namespace magfsi::structure {

// All members are numbers, none negative; the words of fix magttice/drag in their order.
struct Drag {
    double rate_1_s = 0;  // dv/dt = -rate v, on every node

    bool operator==(const Drag&) const = default;
};
using DragNumbers = std::array<double, sizeof(Drag) / sizeof(double)>;

// What is left of a node's velocity after a time; in a header, as every node asks for it
// twice per step.
class DragDecay {
  public:
    DragDecay() = default;
    DragDecay(const Drag& drag, double time_s)
        : linear_(std::exp(-drag.rate_1_s * time_s)) {}

    // As a share of the velocity v, three values.
    double share(const double* /*v*/) const { return linear_; }

  private:
    double linear_ = 1;
};

}  // namespace magfsi::structure
