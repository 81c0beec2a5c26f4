// A coupled step, readable as a list: the tasks that the scene calls for, in order. An
// effect that is absent has no task.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupler/output/task_timer.h"

namespace magfsi::coupler {

// Whose work a task is, for the coupling's overhead.
enum class TaskKind { solver, immersed_boundary, coupling, output };

struct TaskTime {
    std::string name;
    TaskKind kind = TaskKind::solver;
    double seconds = 0;
    double waiting_s = 0;  // of them, for the partner
};

class TaskList {
  public:
    void add(std::string name, std::function<void()> work);  // of the solver
    void add_immersed_boundary(std::string name, std::function<void()> work);
    void add_coupling(std::string name, std::function<void()> work);  // exchange, waiting
    void add_output(std::string name, std::function<void()> work);

    // The tasks from number `first` on up to here are done again as long as `again` says
    // so after the last of them.
    std::size_t size() const { return tasks_.size(); }
    void repeat_from(std::size_t first, std::function<bool()> again);

    // Every task, each timed under its name.
    void run();

    // "advance structure, send impulses, ..."; what is repeated stands in brackets.
    std::string names() const;
    const output::TaskTimer& timer() const { return timer_; }
    std::vector<TaskTime> times() const;  // of the tasks that ran, in their order

  private:
    struct Task {
        std::string name;
        std::function<void()> work;
        TaskKind kind;
        double waiting_s = 0;
    };
    struct Loop {
        std::size_t first = 0, last = 0;
        std::function<bool()> again;
    };
    void run(Task& task);

    std::vector<Task> tasks_;
    std::vector<Loop> loops_;  // in order, none inside another
    output::TaskTimer timer_;
};

}  // namespace magfsi::coupler
