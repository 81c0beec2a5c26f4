// SPDX-License-Identifier: GPL-2.0-or-later
// The trace of a run (--trace): when each task of each rank began and ended, for
// https://ui.perfetto.dev and Chrome's chrome://tracing. Without the option the tasks are
// not wrapped and nothing of this exists.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "coupler/participants/session.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

// The trace of this rank, kept in memory and written when the run ends, however it ends.
class TaskTrace {
  public:
    // Wraps the tasks of the list, which must outlive this object.
    TaskTrace(const Session& session, TaskList& tasks);
    ~TaskTrace();  // writes trace_SIDE_RANK.json: Chrome's trace events, a JSON array
    TaskTrace(const TaskTrace&) = delete;
    TaskTrace& operator=(const TaskTrace&) = delete;

  private:
    struct Event {
        std::int64_t start_ns;
        // Duration of the task, and the part of it spent waiting for the partner.
        std::uint32_t length_ns, waited_ns;
        std::uint32_t task;
    };
    void add(std::uint32_t task, double start_s, double end_s, double waited_s);
    std::string text() const;

    std::filesystem::path file_;
    std::string side_, other_;
    int side_number_, rank_;
    // Offset of the day's clock, which all machines of a run share, from the steady
    // clock.
    double clock_offset_s_;
    std::vector<std::string> names_;
    std::vector<Event> events_;
    std::int64_t left_out_ = 0;  // events beyond the largest number
};

// The trace of this rank; null without --trace.
std::unique_ptr<TaskTrace> trace_of(const Session& session, TaskList& tasks);

}  // namespace magfsi::coupler
