// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi doctor: what a run needs of this machine, tried out, and what to do where it is
// not there.
#pragma once

namespace magfsi::launch {

// Prints a line for each; exit_done if all is well, else exit_error.
int doctor();

}  // namespace magfsi::launch
