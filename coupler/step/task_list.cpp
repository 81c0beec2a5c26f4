#include "coupler/step/task_list.h"

namespace magfsi::coupler {

void TaskList::add(std::string name, std::function<void()> work) {
    tasks_.push_back({std::move(name), std::move(work)});
}

void TaskList::run() {
    for (const Task& task : tasks_) {
        const auto guard = timer_.measure(task.name);
        task.work();
    }
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
