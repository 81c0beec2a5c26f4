// Of builds with MAGFSI_TRAPS: invalid operations, divisions by zero and overflows end
// the process where they happen (SIGFPE), on all of this process's threads to come. In
// other builds the call is empty.
#pragma once

namespace magfsi::coupler {

void trap_floating_point_faults();

}  // namespace magfsi::coupler
