// SPDX-License-Identifier: GPL-2.0-or-later
// How a process sleeps until its partner has sent a message: MPI's waits poll, and a core
// that polls is one that the partner may need. Whoever has sent a message rings the
// receiver's bell, a datagram socket in Linux's abstract name space (unix(7): no file).
// Processes of one machine hear each other; others have to look by themselves.
#pragma once

#include <chrono>

#include "coupler/participants/processes.h"

namespace magfsi::coupler {

class Bell {
  public:
    // From now on self hears. Where the system grants no socket nobody does.
    explicit Bell(const ProcessId& self);
    ~Bell();
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;

    // False where the other one cannot hear it.
    bool ring(const ProcessId& other) const;
    // Until it rings or has rung since the last wait, a signal comes, or that much time
    // has passed. Whether it rang.
    bool wait(std::chrono::nanoseconds longest) const;

  private:
    int socket_ = -1;
};

}  // namespace magfsi::coupler
