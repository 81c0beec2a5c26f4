// Another program on the same box, run by its own command.
#pragma once

#include <string>

#include "tests/bench/lbm/measure.h"

namespace magfsi::bench {

// Million cells stepped per second that the peer prints as its last number; called on one
// rank. Throws std::runtime_error if it cannot be run.
double peer_mlups(const std::string& program, const Settings& settings,
                  const std::string& kind, int ranks);

}  // namespace magfsi::bench
