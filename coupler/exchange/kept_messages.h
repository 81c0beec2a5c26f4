// Messages under way when an exception takes their owner.
#pragma once

#include <vector>

namespace magfsi::coupler {

using Messages = std::vector<std::vector<double>>;

// MPI keeps no copy of a long message: the partner may read it from here until this
// process ends, and would take what came into freed memory for an answer.
inline void keep_until_exit(Messages& messages) {
    static auto& kept = *new std::vector<Messages>;  // never freed
    kept.push_back(std::move(messages));
}

}  // namespace magfsi::coupler
