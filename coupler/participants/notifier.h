// SPDX-License-Identifier: GPL-2.0-or-later
// How a process sleeps until its partner has sent a message: MPI's waits poll, and a core
// that polls is one that the partner may need. Whoever has sent a message notifies the
// receiver by a datagram to a socket in Linux's abstract name space (unix(7): no file).
// Not by a signal, which MPI's own threads could take. Processes of one machine reach
// each other; others have to look by themselves.
#pragma once

#include <chrono>

#include "coupler/participants/processes.h"

namespace magfsi::coupler {

class Notifier {
  public:
    // From now on self can be notified. Where the system grants no socket it cannot.
    explicit Notifier(const ProcessId& self);
    ~Notifier();
    Notifier(const Notifier&) = delete;
    Notifier& operator=(const Notifier&) = delete;

    // False where the other one cannot be notified.
    bool notify(const ProcessId& other) const;
    // Until a notification comes or has come since the last wait, a signal comes, or that
    // much time has passed. Whether there was a notification.
    bool wait(std::chrono::nanoseconds longest) const;

  private:
    int socket_ = -1;
};

}  // namespace magfsi::coupler
