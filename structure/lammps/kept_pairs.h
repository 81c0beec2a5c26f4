// SPDX-License-Identifier: GPL-2.0-or-later
// What a pair style remembers of pairs of atoms, for checkpoints and repeated steps.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace magfsi::structure {

class KeepsPairs {
  public:
    static constexpr std::size_t row_values = 6;

    virtual ~KeepsPairs() = default;
    // Rows of row_values numbers, the same on all ranks; and back.
    virtual std::vector<double> kept_pairs() const = 0;
    virtual void put_pairs(std::span<const double> rows) = 0;
};

}  // namespace magfsi::structure
