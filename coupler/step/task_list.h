// SPDX-License-Identifier: GPL-2.0-or-later
// The coupled step as a readable list of tasks, in the order in which they run, and the
// outputs of a participant. An effect that the scene lacks has no task.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coupler/output/probe_file.h"

namespace magfsi::coupler {

// Kind of work of a task, from which the coupling's overhead is computed.
enum class TaskKind { solver, immersed_boundary, coupling, output };

// Time of a task over all its runs on this rank.
struct TaskTime {
    std::string name;
    TaskKind kind = TaskKind::solver;
    // Seconds, and the part of them spent waiting for the partner.
    double seconds = 0;
    double waiting_s = 0;
};

// The tasks of a coupled step.
class TaskList {
  public:
    using Work = std::function<void()>;
    void add(std::string name, Work work, TaskKind kind = TaskKind::solver);
    void add_immersed_boundary(std::string name, Work work) {
        add(std::move(name), std::move(work), TaskKind::immersed_boundary);
    }
    // Exchange with the partner, and waiting for it.
    void add_coupling(std::string name, Work work) {
        add(std::move(name), std::move(work), TaskKind::coupling);
    }
    void add_output(std::string name, Work work) {
        add(std::move(name), std::move(work), TaskKind::output);
    }

    // Makes the tasks from number `first` to the last one added so far a loop: they are
    // done again as long as again() returns true after the last of them. size() is the
    // number of the next task.
    std::size_t size() const { return tasks_.size(); }
    void repeat_from(std::size_t first, std::function<bool()> again);

    // Replaces the work of each task by a function made from it, which may do something
    // before and after.
    using Wrap = std::function<Work(const std::string& name, const Work& work)>;
    void wrap(const Wrap& around);

    // Runs every task and adds its time.
    void run();

    // "advance structure, send impulses, ..."; a loop stands in brackets.
    std::string names() const;
    // Times of the tasks that ran, in their order.
    std::vector<TaskTime> times() const;
    // Time of a task by name; 0 if it is not in the list.
    double seconds(std::string_view name) const;

  private:
    struct Task {
        TaskTime time;
        Work work;
        bool ran = false;
    };
    struct Loop {
        std::size_t first = 0, last = 0;
        std::function<bool()> again;
    };
    void run(Task& task);

    std::vector<Task> tasks_;
    std::vector<Loop> loops_;  // in order; none is inside another
};

// An output of a participant beside its solution: an object and a task of the step for
// each output that the scene names.
class Output {
  public:
    virtual ~Output() = default;
    // Called before the first step: writes the output of step 0, unless the run continues
    // a checkpoint.
    virtual void begin() {}
    // Called at the end of every coupled step, by all ranks.
    virtual void end_step() = 0;
    // Called on the leading rank when all sides have ended.
    virtual void finish() {}
    // The file of probes from which the summary takes the last values; null for most
    // outputs.
    virtual const output::ProbeFile* probes() const { return nullptr; }
};

// A kind of output that a program is built with. Run: what a participant hands to its
// outputs; it must outlive them. make() returns null if the scene does not name the
// output, on all ranks or on none.
template <class Run>
struct OutputKind {
    // Name of the effect, and of the task.
    std::string_view name;
    const char* task = "";
    std::unique_ptr<Output> (*make)(Run&) = nullptr;
};

// The outputs of a run.
class Outputs {
  public:
    // Makes the outputs that the scene names and adds their tasks. kinds: those of this
    // build, terminated by one without a name.
    template <class Run>
    void add(const OutputKind<Run>* kinds, Run& run, TaskList& tasks) {
        for (; !kinds->name.empty(); ++kinds) {
            names_.push_back(kinds->name);
            std::unique_ptr<Output> output = kinds->make(run);
            if (!output) continue;
            tasks.add_output(kinds->task, [made = output.get()] { made->end_step(); });
            all_.push_back(std::move(output));
        }
    }
    // Throws std::invalid_argument if an output is asked for that this build does not
    // have. Called after add.
    void need(bool asked, std::string_view name) const;

    void begin();
    void finish();
    const output::ProbeFile* probes() const;

  private:
    std::vector<std::string_view> names_;
    std::vector<std::unique_ptr<Output>> all_;  // in the order of their tasks
};

}  // namespace magfsi::coupler
