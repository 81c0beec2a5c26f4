// SPDX-License-Identifier: GPL-2.0-or-later
// What the two sides agree on at their start, and what their roots tell each other
// besides the markers.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "coupler/participants/world.h"

namespace magfsi::coupler {

// What both sides must agree on before any data flows. Same layout on both: all integers,
// so that there is nothing to round.
struct Agreement {
    std::int64_t protocol = 3;
    std::uint64_t scene_hash = 0;
    std::int64_t steps = 0;       // coupled steps of the run
    std::int64_t step_ps = 0;     // the coupled step in picoseconds, rounded
    std::int64_t first_step = 0;  // that of the checkpoint after a restart
};

// Exchanges the agreements of the two roots and compares. Throws PartnerLost naming the
// first item that differs and both values. Collective over both sides.
void shake_hands(const World& world, const Agreement& mine, double timeout_s);

// Exchanges a block of numbers between the roots and broadcasts it to every local rank;
// the sizes are known to both sides. For geometry and reports at start-up and at the end.
void swap_with_partner(const World& world, const void* send, int send_bytes,
                       void* receive, int receive_bytes, double timeout_s,
                       const char* what);

// The same for a text of any length.
std::string swap_text(const World& world, const std::string& mine, double timeout_s,
                      const char* what);

// Numbers from the fluid's root to the structure's root at coupled step `step`.
void send_numbers(const World& world, std::int64_t step, std::span<const double> numbers,
                  double timeout_s);
void receive_numbers(const World& world, std::int64_t step, std::span<double> numbers,
                     double timeout_s);

}  // namespace magfsi::coupler
