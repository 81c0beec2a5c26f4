// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/participants/notifier.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <ctime>
#include <string>

namespace magfsi::coupler {

namespace {

struct Address {
    sockaddr_un name{};
    socklen_t size = 0;
};

// The address that a process's socket is bound to; every other process can compute it.
Address address_of(const ProcessId& process) {
    const std::string text =
        fmt::format("magfsi-{:x}-{}-{}", process.machine, process.pid, process.started);
    Address address;
    address.name.sun_family = AF_UNIX;
    // A zero byte in front makes the name an abstract one.
    text.copy(address.name.sun_path + 1, sizeof address.name.sun_path - 1);
    address.size =
        static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
    return address;
}

const sockaddr* generic(const Address& address) {
    return reinterpret_cast<const sockaddr*>(&address.name);
}

}  // namespace

Notifier::Notifier(const ProcessId& self)
    : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    const Address address = address_of(self);
    if (socket_ < 0 || ::bind(socket_, generic(address), address.size) == 0) return;
    ::close(socket_);
    socket_ = -1;
}

Notifier::~Notifier() {
    if (socket_ >= 0) ::close(socket_);
}

bool Notifier::notify(const ProcessId& other) const {
    if (socket_ < 0) return false;
    const Address address = address_of(other);
    const char byte = 0;
    const ssize_t sent = ::sendto(socket_, &byte, sizeof byte, MSG_NOSIGNAL,
                                  generic(address), address.size);
    // A full queue holds notifications that were not read yet: one more would add
    // nothing.
    return sent >= 0 || errno == EAGAIN;
}

bool Notifier::wait(std::chrono::nanoseconds longest) const {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(longest);
    const timespec time{seconds.count(), (longest - seconds).count()};
    pollfd one{socket_, POLLIN, 0};
    if (::ppoll(&one, 1, &time, nullptr) <= 0) return false;
    // Takes all notifications that have come: one wake-up answers all of them.
    char byte = 0;
    while (::recv(socket_, &byte, sizeof byte, 0) >= 0) {
    }
    return true;
}

}  // namespace magfsi::coupler
