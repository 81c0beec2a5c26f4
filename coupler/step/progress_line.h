// The progress of a participant that leads, on its standard output.
#pragma once

#include <memory>

#include "coupler/output/progress.h"
#include "coupler/participants/session.h"

namespace magfsi::coupler {

// After session.begin. Give it the completed steps: update() in every step.
std::unique_ptr<output::Progress> progress_on_stdout(const Session& session,
                                                     output::ProgressMode mode);

}  // namespace magfsi::coupler
