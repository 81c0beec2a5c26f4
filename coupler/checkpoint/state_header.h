// What every file of a checkpoint says of itself.
#pragma once

#include <cstdint>

namespace magfsi::coupler {

struct StateHeader {
    std::uint64_t state_hash = 0;  // of the scene, whatever its end (scene::state_hash)
    std::int64_t step = 0;         // coupled steps that were completed
    double step_s = 0;             // the coupled step
};

constexpr std::int64_t state_format = 1;

}  // namespace magfsi::coupler
