// What stands at the head of a run's log: the effects of each step, those that are
// absent, and warnings of those that can do nothing.
#pragma once

#include "coupler/participants/session.h"

namespace magfsi::coupler {

void log_effects(const Session& session);

}  // namespace magfsi::coupler
