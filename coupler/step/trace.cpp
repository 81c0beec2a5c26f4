// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/step/trace.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "coupler/output/file.h"
#include "coupler/output/log.h"
#include "coupler/participants/waiting.h"

namespace magfsi::coupler {

namespace {

// Largest number of events, about 24 MB of text per rank, which Perfetto opens in a
// second or two.
constexpr std::size_t most_events = 200000;

std::int64_t ns(double seconds) {
    return 1e9 * seconds;
}

// The time of day [s] since the epoch.
double day_clock_s() {
    return std::chrono::duration<double>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

std::string quoted(const std::string& text) {
    return nlohmann::json(text).dump();
}

}  // namespace

TaskTrace::TaskTrace(const Session& session, TaskList& tasks)
    : side_(to_string(session.world().self())),
      other_(to_string(session.world().other())),
      side_number_(static_cast<int>(session.world().self())),
      rank_(session.world().rank()),
      clock_offset_s_(day_clock_s() - output::steady_seconds()) {
    file_ = session.out() / fmt::format("trace_{}_{}.json", side_, rank_);
    tasks.wrap([this](const std::string& name, const TaskList::Work& work) {
        const auto number = static_cast<std::uint32_t>(names_.size());
        names_.push_back(name);
        return [this, number, work] {
            const double waited_before_s = waited_s();
            const double start_s = output::steady_seconds();
            work();
            add(number, start_s, output::steady_seconds(), waited_s() - waited_before_s);
        };
    });
}

void TaskTrace::add(std::uint32_t task, double start_s, double end_s, double waited_s) {
    if (events_.size() == most_events) {
        ++left_out_;
        return;
    }
    constexpr double longest_s = 4;  // limit of 32 bits in ns; longer tasks are cut
    events_.push_back(
        {ns(clock_offset_s_ + start_s),
         static_cast<std::uint32_t>(ns(std::min(longest_s, end_s - start_s))),
         static_cast<std::uint32_t>(ns(std::min(longest_s, waited_s))), task});
}

// The trace in Chrome's JSON format. The waiting part of a task is drawn at its end,
// since what was waited for is used next.
std::string TaskTrace::text() const {
    const std::string place = fmt::format("\"pid\":{},\"tid\":{}", side_number_, rank_);
    std::string out = fmt::format(
        "[\n{{\"ph\":\"M\",{0},\"name\":\"process_name\",\"args\":{{\"name\":{1}}}}},\n"
        "{{\"ph\":\"M\",{0},\"name\":\"thread_name\",\"args\":{{\"name\":\"rank {2}\","
        "\"left_out\":{3}}}}}",
        place, quoted(side_), rank_, left_out_);
    const auto add_event = [&](const std::string& name, const char* kind,
                               std::int64_t start_ns, std::int64_t length_ns) {
        out += fmt::format(
            ",\n{{\"ph\":\"X\",{},\"cat\":\"{}\",\"name\":{},\"ts\":{}.{:03},"
            "\"dur\":{}.{:03}}}",
            place, kind, name, start_ns / 1000, start_ns % 1000, length_ns / 1000,
            length_ns % 1000);
    };
    std::vector<std::string> names;
    for (const std::string& name : names_) names.push_back(quoted(name));
    const std::string waiting = quoted("waits for the " + other_);
    for (const Event& event : events_) {
        add_event(names[event.task], "task", event.start_ns, event.length_ns);
        if (event.waited_ns > 0)
            add_event(waiting, "waiting",
                      event.start_ns + event.length_ns - event.waited_ns,
                      event.waited_ns);
    }
    return out + "\n]\n";
}

TaskTrace::~TaskTrace() {
    try {
        output::write_atomically(file_, text());
    } catch (const std::exception& fault) {
        fmt::print(stderr, "magfsi: {}\n", fault.what());
    }
}

std::unique_ptr<TaskTrace> trace_of(const Session& session, TaskList& tasks) {
    if (!session.traced()) return nullptr;
    return std::make_unique<TaskTrace>(session, tasks);
}

}  // namespace magfsi::coupler
