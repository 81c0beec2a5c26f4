#include "coupler/step/task_list.h"

#include "coupler/participants/wait.h"

namespace magfsi::coupler {

void TaskList::add(std::string name, std::function<void()> work) {
    tasks_.push_back({std::move(name), std::move(work), TaskKind::solver});
}

void TaskList::add_immersed_boundary(std::string name, std::function<void()> work) {
    tasks_.push_back({std::move(name), std::move(work), TaskKind::immersed_boundary});
}

void TaskList::add_coupling(std::string name, std::function<void()> work) {
    tasks_.push_back({std::move(name), std::move(work), TaskKind::coupling});
}

void TaskList::add_output(std::string name, std::function<void()> work) {
    tasks_.push_back({std::move(name), std::move(work), TaskKind::output});
}

void TaskList::repeat_from(std::size_t first, std::function<bool()> again) {
    loops_.push_back({first, tasks_.size() - 1, std::move(again)});
}

void TaskList::run(Task& task) {
    const auto guard = timer_.measure(task.name);
    const double waited_before_s = waited_s();
    task.work();
    task.waiting_s += waited_s() - waited_before_s;
}

void TaskList::run() {
    auto loop = loops_.begin();
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
        run(tasks_[i]);
        if (loop == loops_.end() || i != loop->last) continue;
        if (loop->again())
            i = loop->first - 1;  // unsigned: wraps to 0 with the increment
        else
            ++loop;
    }
}

std::vector<TaskTime> TaskList::times() const {
    std::vector<TaskTime> all;
    for (const auto& [name, seconds] : timer_.seconds()) {
        for (const Task& task : tasks_) {
            if (task.name == name)
                all.push_back({name, task.kind, seconds, task.waiting_s});
        }
    }
    return all;
}

std::string TaskList::names() const {
    std::string all;
    auto loop = loops_.begin();
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
        if (i > 0) all += ", ";
        if (loop != loops_.end() && i == loop->first) all += "repeat (";
        all += tasks_[i].name;
        if (loop == loops_.end() || i != loop->last) continue;
        all += ")";
        ++loop;
    }
    return all;
}

}  // namespace magfsi::coupler
