// SPDX-License-Identifier: GPL-2.0-or-later
// Interface to the state that a pair style keeps for pairs of atoms, such as friction
// springs, for checkpoints and repeated steps.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace magfsi::structure {

// A pair style with such a state.
class KeepsPairs {
  public:
    // Number of values in a row, one row per pair
    static constexpr std::size_t row_values = 6;

    virtual ~KeepsPairs() = default;
    // All pairs as rows of row_values numbers, the same on all ranks (collective).
    virtual std::vector<double> kept_pairs() const = 0;
    // Replaces the state by such rows.
    virtual void put_pairs(std::span<const double> rows) = 0;
};

}  // namespace magfsi::structure
