// SPDX-License-Identifier: GPL-2.0-or-later
// How long the look-up of this host's own name takes: each start of MPI waits for it.
#pragma once

#include <string>

namespace magfsi::launch {

// Empty, or what is wrong with the name and how to cure it. Waits for the name server,
// which may take some seconds.
std::string fault_of_host_name();

// The host's name.
std::string host_name();

// Looks the name up beside whatever follows, and says on stderr what is wrong with it.
void warn_of_host_name();

}  // namespace magfsi::launch
