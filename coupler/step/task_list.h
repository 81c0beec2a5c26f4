// SPDX-License-Identifier: GPL-2.0-or-later
// A coupled step, readable as a list: the tasks that the scene calls for, in order, and
// what a participant writes beside its solution. An effect that is absent has no task.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coupler/output/probe_file.h"

namespace magfsi::coupler {

// Whose work a task is, for the coupling's overhead.
enum class TaskKind { solver, immersed_boundary, coupling, output };

struct TaskTime {
    std::string name;
    TaskKind kind = TaskKind::solver;
    double seconds = 0;    // so far
    double waiting_s = 0;  // of them, for the partner
};

class TaskList {
  public:
    using Work = std::function<void()>;
    void add(std::string name, Work work, TaskKind kind = TaskKind::solver);
    void add_immersed_boundary(std::string name, Work work) {
        add(std::move(name), std::move(work), TaskKind::immersed_boundary);
    }
    void add_coupling(std::string name, Work work) {  // exchange, waiting
        add(std::move(name), std::move(work), TaskKind::coupling);
    }
    void add_output(std::string name, Work work) {
        add(std::move(name), std::move(work), TaskKind::output);
    }

    // The tasks from number `first` on up to here are done again as long as `again` says
    // so after the last of them.
    std::size_t size() const { return tasks_.size(); }
    void repeat_from(std::size_t first, std::function<bool()> again);

    // Puts something around the work of each task.
    using Wrap = std::function<Work(const std::string& name, const Work& work)>;
    void wrap(const Wrap& around);

    // Every task, each timed under its name.
    void run();

    // "advance structure, send impulses, ..."; what is repeated stands in brackets.
    std::string names() const;
    std::vector<TaskTime> times() const;          // of the tasks that ran, in their order
    double seconds(std::string_view name) const;  // 0 for one that is not in the list

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
    std::vector<Loop> loops_;  // in order, none inside another
};

// What a participant writes beside its solution: an object for each output that the scene
// names, and a task of the step.
class Output {
  public:
    virtual ~Output() = default;
    // Before the first step: what is written of step 0, where the run does not go on from
    // a checkpoint.
    virtual void begin() {}
    virtual void end_step() = 0;
    virtual void finish() {}  // when all sides have ended; on the leading rank
    // What the summary is made from; null on most.
    virtual const output::ProbeFile* probes() const { return nullptr; }
};

// Run: what a participant hands to its outputs, which lives as long as they do. make
// returns null where the scene does not name the output, on all ranks or on none.
template <class Run>
struct OutputKind {
    std::string_view name;  // of the effect
    const char* task = "";
    std::unique_ptr<Output> (*make)(Run&) = nullptr;
};

class Outputs {
  public:
    // kinds: those of this build, up to one without a name.
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
    // After add. Throws std::invalid_argument where the build lacks what is asked for.
    void need(bool asked, std::string_view name) const;

    void begin();
    void finish();
    const output::ProbeFile* probes() const;

  private:
    std::vector<std::string_view> names_;
    std::vector<std::unique_ptr<Output>> all_;  // in the order of their tasks
};

}  // namespace magfsi::coupler
