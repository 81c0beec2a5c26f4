// SPDX-License-Identifier: GPL-2.0-or-later
// Sleeping until the partner has sent a message. MPI's own waits poll, and a core that
// polls may be one that the partner needs. A process that has sent a message therefore
// notifies the receiver by a datagram to a socket in Linux's abstract name space
// (unix(7): no file is made). A signal would not do, since MPI's own threads could take
// it. Only processes of one machine reach each other; others must poll.
#pragma once

#include <chrono>

#include "coupler/participants/processes.h"

namespace magfsi::coupler {

// The socket of this process.
class Notifier {
  public:
    // Opens the socket of process `self`, which must be this process. If the system
    // grants none, the other calls have no effect.
    explicit Notifier(const ProcessId& self);
    ~Notifier();
    Notifier(const Notifier&) = delete;
    Notifier& operator=(const Notifier&) = delete;

    // Notifies another process; returns false if it cannot be reached.
    bool notify(const ProcessId& other) const;
    // Sleeps until a notification comes or one has come since the last wait, or a signal
    // comes, or the time has passed. Returns true if there was a notification.
    bool wait(std::chrono::nanoseconds longest) const;

  private:
    int socket_ = -1;
};

}  // namespace magfsi::coupler
