#pragma once

#include "coupler/checkpoint/state_reader.h"
#include "coupler/participants/session.h"

namespace magfsi::coupler {

// This participant's file of the checkpoint that the session goes on from.
StateReader open_restart(const Session& session);

}  // namespace magfsi::coupler
