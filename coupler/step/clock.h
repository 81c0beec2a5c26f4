// SPDX-License-Identifier: GPL-2.0-or-later
// Time as an integer number of coupled steps: seconds are computed from it and never
// accumulated.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace magfsi::coupler {

// The clock of a run.
class Clock {
  public:
    // Runs from 0 to the first step at or after end_s [s]. An excess of 1e-9 of a step
    // counts as none, and so does the rounding of an end that was meant to be a whole
    // number of steps. at_a_time: the end and periodic events lie at multiples of this
    // number of steps.
    Clock(double step_s, double end_s, int at_a_time = 1)
        : step_s_(step_s),
          at_a_time_(at_a_time),
          steps_(at_a_time * first_at_or_after(end_s / (at_a_time * step_s))) {}

    double step_s() const { return step_s_; }
    std::int64_t steps() const { return steps_; }
    std::int64_t step() const { return step_; }
    double time_s() const { return time_s(step_); }
    double time_s(std::int64_t step) const { return 1.0 * step * step_s_; }
    bool done() const { return step_ >= steps_; }
    void tick() { ++step_; }

    // Sets the step of a restart; called before the first tick.
    void start_at(std::int64_t step) { step_ = first_step_ = step; }
    std::int64_t first_step() const { return first_step_; }
    std::int64_t steps_here() const { return step_ - first_step_; }  // steps of this run

    // Number of steps between events that are wanted every interval_s [s]; at least one.
    std::int64_t every(double interval_s) const {
        const std::int64_t steps = std::llround(interval_s / (at_a_time_ * step_s_));
        return at_a_time_ * (steps < 1 ? 1 : steps);
    }

  private:
    static std::int64_t first_at_or_after(double quotient) {
        // Tolerance for a few roundings, of the quotient and of the numbers in it.
        constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
        const double tolerance = std::max(1e-9, rounding * quotient);
        return static_cast<std::int64_t>(std::ceil(quotient - tolerance));
    }

    double step_s_;
    int at_a_time_;
    std::int64_t steps_;
    std::int64_t step_ = 0, first_step_ = 0;
};

}  // namespace magfsi::coupler
