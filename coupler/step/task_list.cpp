// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/step/task_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupler/output/log.h"
#include "coupler/participants/waiting.h"

namespace magfsi::coupler {

void TaskList::add(std::string name, Work work, TaskKind kind) {
    tasks_.push_back({{std::move(name), kind}, std::move(work)});
}

void TaskList::repeat_from(std::size_t first, std::function<bool()> again) {
    loops_.push_back({first, tasks_.size() - 1, std::move(again)});
}

void TaskList::wrap(const Wrap& around) {
    for (Task& task : tasks_) task.work = around(task.time.name, task.work);
}

void TaskList::run(Task& task) {
    const double start_s = output::steady_seconds();
    const double waited_before_s = waited_s();
    task.work();
    task.time.seconds += output::steady_seconds() - start_s;
    task.time.waiting_s += waited_s() - waited_before_s;
    task.ran = true;
}

void TaskList::run() {
    auto loop = loops_.begin();
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
        run(tasks_[i]);
        if (loop == loops_.end() || i != loop->last) continue;
        if (loop->again())
            i = loop->first - 1;  // unsigned: for 0 the increment wraps to 0
        else
            ++loop;
    }
}

std::vector<TaskTime> TaskList::times() const {
    std::vector<TaskTime> all;
    for (const Task& task : tasks_)
        if (task.ran) all.push_back(task.time);
    return all;
}

double TaskList::seconds(std::string_view name) const {
    for (const Task& task : tasks_)
        if (task.time.name == name) return task.time.seconds;
    return 0;
}

std::string TaskList::names() const {
    std::string all;
    auto loop = loops_.begin();
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
        if (i > 0) all += ", ";
        if (loop != loops_.end() && i == loop->first) all += "repeat (";
        all += tasks_[i].time.name;
        if (loop == loops_.end() || i != loop->last) continue;
        all += ")";
        ++loop;
    }
    return all;
}

void Outputs::need(bool asked, std::string_view name) const {
    if (!asked || std::ranges::find(names_, name) != names_.end()) return;
    throw std::invalid_argument(
        fmt::format("{} is asked for, and this program was built without it; leave its "
                    "key out, or build the program with it",
                    name));
}

void Outputs::begin() {
    for (const auto& output : all_) output->begin();
}

void Outputs::finish() {
    for (const auto& output : all_) output->finish();
}

const output::ProbeFile* Outputs::probes() const {
    for (const auto& output : all_) {
        if (const output::ProbeFile* file = output->probes()) return file;
    }
    return nullptr;
}

}  // namespace magfsi::coupler
