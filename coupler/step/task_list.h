// A coupled step, readable as a list: the tasks that the scene calls for, in order. An
// effect that is absent has no task.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupler/output/task_timer.h"

namespace magfsi::coupler {

class TaskList {
  public:
    void add(std::string name, std::function<void()> work);

    // Every task once, each timed under its name.
    void run();

    std::string names() const;  // "advance structure, send impulses, ..."
    const output::TaskTimer& timer() const { return timer_; }

  private:
    struct Task {
        std::string name;
        std::function<void()> work;
    };
    std::vector<Task> tasks_;
    output::TaskTimer timer_;
};

}  // namespace magfsi::coupler
