// What stands at the head of a run's log: the effects of each step, those that are
// absent, warnings of those that can do nothing, and the tasks of each side's step.
#pragma once

#include <string>

#include "coupler/participants/session.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

void log_effects(const Session& session);

// "structure step: ..." and, in a coupled run, what the other side says of itself, which
// calls this, too, before the first exchange. First a line on this side, if not empty.
void log_steps(const Session& session, const TaskList& tasks,
               const std::string& about = "");

}  // namespace magfsi::coupler
