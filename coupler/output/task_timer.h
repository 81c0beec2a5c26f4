// Where the time goes: seconds by task, for summary.json.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coupler/output/clock.h"

namespace magfsi::output {

// Time inside a nested task counts for that task alone, so that the tasks add up to no
// more than the wall time. About 0.1 microseconds a guard. One thread.
class TaskTimer {
  public:
    explicit TaskTimer(Clock clock = steady_seconds);

    class Guard {
      public:
        ~Guard() { timer_.switch_to(outer_); }
        Guard(const Guard&) = delete;
        Guard& operator=(const Guard&) = delete;

      private:
        friend class TaskTimer;
        Guard(TaskTimer& timer, std::size_t outer) : timer_(timer), outer_(outer) {}
        TaskTimer& timer_;
        std::size_t outer_;
    };

    // Guards must end in the reverse of their order, as local variables do.
    [[nodiscard]] Guard measure(std::string_view task);

    // In the order of first use; a running task counts up to its last switch.
    const std::vector<std::pair<std::string, double>>& seconds() const {
        return seconds_;
    }

  private:
    std::size_t index_of(std::string_view task);
    void switch_to(std::size_t task);

    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    Clock clock_;
    std::vector<std::pair<std::string, double>> seconds_;
    std::size_t current_ = none;
    double last_s_ = 0;
};

}  // namespace magfsi::output
