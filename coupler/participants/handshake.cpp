// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/participants/handshake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "coupler/participants/errors.h"
#include "coupler/participants/waiting.h"

namespace magfsi::coupler {

namespace {

constexpr int swap_tag = 72;
constexpr int numbers_tag = 73;

// Throws PartnerLost if an item differs between the sides.
template <class Number>
void compare(const World& world, const char* item, Number mine, Number theirs,
             const char* format = "{}") {
    if (mine == theirs) return;
    throw PartnerLost(
        fmt::format("{} and {} disagree on the {}: {} here, {} there; start both with "
                    "the same scene file and the same --set options, from the same build",
                    to_string(world.self()), to_string(world.other()), item,
                    fmt::format(fmt::runtime(format), mine),
                    fmt::format(fmt::runtime(format), theirs)));
}

}  // namespace

void swap_with_partner(const World& world, const void* send, int send_bytes,
                       void* receive, int receive_bytes, double timeout_s,
                       const char* what) {
    if (world.root()) {
        const std::string name =
            fmt::format("{} of the {}", what, to_string(world.other()));
        MPI_Request sending;
        world.send(send, send_bytes, MPI_BYTE, 0, swap_tag, &sending);
        world.receive_from_root(receive, receive_bytes, MPI_BYTE, swap_tag, timeout_s,
                                name);
        wait_all({&sending, 1}, timeout_s, name);
    }
    MPI_Bcast(receive, receive_bytes, MPI_BYTE, 0, world.local());
}

void shake_hands(const World& world, const Agreement& mine, double timeout_s) {
    Agreement theirs;
    swap_with_partner(world, &mine, sizeof mine, &theirs, sizeof theirs, timeout_s,
                      "handshake");
    compare(world, "protocol version", mine.protocol, theirs.protocol);
    compare(world, "scene (hash)", mine.scene_hash, theirs.scene_hash, "{:016x}");
    compare(world, "number of coupled steps", mine.steps, theirs.steps);
    compare(world, "coupled step in picoseconds", mine.step_ps, theirs.step_ps);
    compare(world, "step of the checkpoint to go on from", mine.first_step,
            theirs.first_step);
}

std::string swap_text(const World& world, const std::string& mine, double timeout_s,
                      const char* what) {
    const std::int64_t my_size = mine.size();
    std::int64_t size = 0;
    swap_with_partner(world, &my_size, sizeof my_size, &size, sizeof size, timeout_s,
                      what);
    std::string theirs(size, ' ');
    swap_with_partner(world, mine.data(), static_cast<int>(mine.size()), theirs.data(),
                      static_cast<int>(size), timeout_s, what);
    return theirs;
}

void send_numbers(const World& world, std::int64_t step, std::span<const double> numbers,
                  double timeout_s) {
    std::vector<double> message{static_cast<double>(step)};
    message.insert(message.end(), numbers.begin(), numbers.end());
    MPI_Request request;
    world.send(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, 0,
               numbers_tag, &request);
    wait_all({&request, 1}, timeout_s,
             fmt::format("receiver of the probes of step {}", step));
}

void receive_numbers(const World& world, std::int64_t step, std::span<double> numbers,
                     double timeout_s) {
    std::vector<double> message(numbers.size() + 1);
    world.receive_from_root(message.data(), static_cast<int>(message.size()), MPI_DOUBLE,
                            numbers_tag, timeout_s,
                            fmt::format("fluid probes of step {}", step));
    if (static_cast<std::int64_t>(message[0]) != step) {
        throw PartnerLost(
            fmt::format("the two sides are out of step: fluid probes of step {} came at "
                        "step {}; start both with the same scene, from the same build",
                        message[0], step));
    }
    std::copy(message.begin() + 1, message.end(), numbers.begin());
}

}  // namespace magfsi::coupler
