// SPDX-License-Identifier: GPL-2.0-or-later
// Look-up of this host's own name. Each start of MPI waits for it, and a slow or missing
// name server delays every run.
#pragma once

#include <string>

namespace magfsi::launch {

// Returns "" if the look-up takes less than half a second, else what is wrong with the
// name and the cure. Waits for the name server, which may take several seconds.
std::string fault_of_host_name();

// The host's name as the system has it.
std::string host_name();

// Looks the name up in a thread of its own while the program goes on, and warns on stderr
// if the look-up is slow.
void warn_of_host_name();

}  // namespace magfsi::launch
