// A coupled step, readable as a list: the tasks that the scene calls for, in order. An
// effect that is absent has no task.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupler/output/task_timer.h"

namespace magfsi::coupler {

// Whose work a task is, for the coupling's overhead.
enum class TaskKind { solver, coupling, output };

struct TaskTime {
    std::string name;
    TaskKind kind = TaskKind::solver;
    double seconds = 0;
    double waiting_s = 0;  // of them, for the partner
};

class TaskList {
  public:
    void add(std::string name, std::function<void()> work);  // of the solver
    void add_coupling(std::string name, std::function<void()> work);
    void add_output(std::string name, std::function<void()> work);

    // Every task once, each timed under its name.
    void run();

    std::string names() const;  // "advance structure, send impulses, ..."
    const output::TaskTimer& timer() const { return timer_; }
    std::vector<TaskTime> times() const;  // of the tasks that ran, in their order

  private:
    struct Task {
        std::string name;
        std::function<void()> work;
        TaskKind kind;
        double waiting_s = 0;
    };
    std::vector<Task> tasks_;
    output::TaskTimer timer_;
};

}  // namespace magfsi::coupler
