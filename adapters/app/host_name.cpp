// SPDX-License-Identifier: GPL-2.0-or-later
// The look-up uses getaddrinfo, as MPI does at its start.
#include "adapters/app/host_name.h"

#include <fmt/format.h>
#include <netdb.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <thread>

namespace magfsi::launch {

std::string host_name() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

// The same look-up as MPI does at start, timed. A name that is quickly not found does no
// harm.
std::string fault_of_host_name() {
    using Clock = std::chrono::steady_clock;
    constexpr double noticeable_s = 0.5;
    const std::string name = host_name();
    const auto start = Clock::now();
    addrinfo* found = nullptr;
    const int fault = getaddrinfo(name.c_str(), nullptr, nullptr, &found);
    if (fault == 0) freeaddrinfo(found);
    const double took_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (took_s < noticeable_s) return "";
    return fmt::format(
        "this host's name, {0}, is {1} after {2:.1f} s, which every start of MPI waits "
        "for; cure: write the line \"127.0.1.1 {0}\" to /etc/hosts",
        name, fault != 0 ? "not found" : "found", took_s);
}

void warn_of_host_name() {
    // The thread is detached: the end of the program ends a look-up that is still
    // waiting.
    std::thread([] {
        const std::string fault = fault_of_host_name();
        if (!fault.empty()) fmt::print(stderr, "warning: {}\n", fault);
    }).detach();
}

}  // namespace magfsi::launch
