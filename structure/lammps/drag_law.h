// SPDX-License-Identifier: GPL-2.0-or-later
// Drag on all nodes: its option and its law. A further law is a member of Drag and a
// factor in DragDecay, and a key of the scene.
#pragma once

#include <array>
#include <cmath>

namespace magfsi::structure {

// Options of the drag. All members are numbers, none negative, and their order is that of
// the words of fix magttice/drag.
struct Drag {
    double rate_1_s = 0;  // dv/dt = -rate v on every node

    bool operator==(const Drag&) const = default;
};
using DragNumbers = std::array<double, sizeof(Drag) / sizeof(double)>;

// Factor by which drag reduces a node's velocity within a given time. Inline, as it is
// evaluated twice per node and step.
class DragDecay {
  public:
    DragDecay() = default;
    DragDecay(const Drag& drag, double time_s)
        : linear_(std::exp(-drag.rate_1_s * time_s)) {}

    // The factor for a node of the velocity v [m/s], three values.
    double share(const double* /*v*/) const { return linear_; }

  private:
    double linear_ = 1;
};

}  // namespace magfsi::structure
