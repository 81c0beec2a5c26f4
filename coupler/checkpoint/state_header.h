// What every file of a checkpoint says of itself.
#pragma once

#include <cmath>
#include <cstdint>

namespace magfsi::coupler {

struct StateHeader {
    std::uint64_t state_hash = 0;  // of the scene, whatever its end
    std::int64_t step = 0;         // coupled steps that were completed
    double step_s = 0;             // the coupled step

    // How many steps of a run there are in one of the state's: a power of two where a
    // retry goes on with smaller ones, 0 where no whole number fits.
    std::int64_t steps_in_one(double run_step_s) const {
        const double ratio = step_s / run_step_s;
        const bool whole = ratio >= 1 && ratio == std::floor(ratio) && ratio < 1e6;
        return whole ? static_cast<std::int64_t>(ratio) : 0;
    }
};

constexpr std::int64_t state_format = 1;

}  // namespace magfsi::coupler
