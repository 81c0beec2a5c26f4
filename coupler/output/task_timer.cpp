#include "coupler/output/task_timer.h"

namespace magfsi::output {

TaskTimer::TaskTimer(Clock clock) : clock_(std::move(clock)) {}

TaskTimer::Guard TaskTimer::measure(std::string_view task) {
    const std::size_t outer = current_;
    switch_to(index_of(task));
    return {*this, outer};
}

std::size_t TaskTimer::index_of(std::string_view task) {
    // A handful of tasks: a walk is faster than a map.
    for (std::size_t i = 0; i < seconds_.size(); ++i)
        if (seconds_[i].first == task) return i;
    seconds_.emplace_back(task, 0.0);
    return seconds_.size() - 1;
}

void TaskTimer::switch_to(std::size_t task) {
    const double now_s = clock_();
    if (current_ != none) seconds_[current_].second += now_s - last_s_;
    last_s_ = now_s;
    current_ = task;
}

}  // namespace magfsi::output
