// What a participant writes beside its solution: an object for each output that the scene
// names, and a task of the step.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "coupler/output/probe_file.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

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
