// The clock of progress and timings, replaceable in tests.
#pragma once

#include <chrono>
#include <functional>

namespace magfsi::output {

// Seconds since some fixed instant; never goes back.
using Clock = std::function<double()>;

inline double steady_seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace magfsi::output
