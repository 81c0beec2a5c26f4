// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi doctor: tries out everything that a run needs of this machine and says how to
// cure each fault.
#pragma once

namespace magfsi::launch {

// Prints one line per check to stdout. Returns exit_done if all of them pass, else
// exit_error. Starts a short MPI job and makes temporary folders, which it removes.
int doctor();

}  // namespace magfsi::launch
