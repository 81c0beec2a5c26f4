// SPDX-License-Identifier: GPL-2.0-or-later
// The handshake of the two sides at their start, and messages between their roots besides
// the markers.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "coupler/participants/world.h"

namespace magfsi::coupler {

// Items that both sides must agree on before any data flows. The layout is the same on
// both sides; all items are integers, so that nothing is rounded.
struct Agreement {
    // Version of the messages between the sides.
    std::int64_t protocol = 3;
    // Hash of the scene.
    std::uint64_t scene_hash = 0;
    std::int64_t steps = 0;       // coupled steps of the run
    std::int64_t step_ps = 0;     // the coupled step in picoseconds, rounded
    std::int64_t first_step = 0;  // step of the checkpoint after a restart
};

// Exchanges the agreements of the two roots and compares them. Throws PartnerLost that
// names the first item that differs and both values. Collective over both sides.
void shake_hands(const World& world, const Agreement& mine, double timeout_s);

// Exchanges a block of bytes between the two roots and broadcasts the received one to all
// ranks of each side. Both sides must know both sizes. For geometry at start-up and
// reports at the end; what: a name for error messages. Collective over both sides.
void swap_with_partner(const World& world, const void* send, int send_bytes,
                       void* receive, int receive_bytes, double timeout_s,
                       const char* what);

// The same for a text of any length; returns the partner's text. Only the root's text is
// sent.
std::string swap_text(const World& world, const std::string& mine, double timeout_s,
                      const char* what);

// Send numbers from the fluid's root to the structure's root at a coupled step; called on
// these ranks only. The receiver must know how many come. receive_numbers throws
// PartnerLost if they are of another step.
void send_numbers(const World& world, std::int64_t step, std::span<const double> numbers,
                  double timeout_s);
void receive_numbers(const World& world, std::int64_t step, std::span<double> numbers,
                     double timeout_s);

}  // namespace magfsi::coupler
