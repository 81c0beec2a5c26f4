#include "coupler/step/task_list.h"

#include "coupler/participants/wait.h"

namespace magfsi::coupler {

void TaskList::add(std::string name, std::function<void()> work) {
    tasks_.push_back({std::move(name), std::move(work), TaskKind::solver});
}

void TaskList::add_coupling(std::string name, std::function<void()> work) {
    tasks_.push_back({std::move(name), std::move(work), TaskKind::coupling});
}

void TaskList::add_output(std::string name, std::function<void()> work) {
    tasks_.push_back({std::move(name), std::move(work), TaskKind::output});
}

void TaskList::run() {
    for (Task& task : tasks_) {
        const auto guard = timer_.measure(task.name);
        const double waited_before_s = waited_s();
        task.work();
        task.waiting_s += waited_s() - waited_before_s;
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
    for (const Task& task : tasks_) {
        if (!all.empty()) all += ", ";
        all += task.name;
    }
    return all;
}

}  // namespace magfsi::coupler
