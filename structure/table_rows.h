// SPDX-License-Identifier: GPL-2.0-or-later
// Interpolation between the rows of a table over time: linear between rows, the first
// row's value before them; after them the last row's value or, with `repeat`, all rows
// repeated with the period of the table. Two rows of one time are a jump: from that time
// on the later one holds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/vector/vec3.h"

namespace magfsi::structure {

// A place between two rows: (1 - share) of `row` plus `share` of `next`.
struct Between {
    std::size_t row = 0, next = 0;
    double share = 0;

    // Value of a column at this place. A column of one value holds for all rows.
    double of(const std::vector<double>& value) const {
        if (value.size() == 1) return value.front();
        return value[row] + share * (value[next] - value[row]);
    }
    Vec3 of(const std::vector<Vec3>& value) const {
        return value[row] + share * (value[next] - value[row]);
    }
};

// Place of a time in a table. times: not descending; empty for a table of one row.
inline Between rows_at(const std::vector<double>& times, bool repeat, double time) {
    if (times.empty()) return {};
    double t = time;
    if (repeat && time > times.front()) {
        const double period = times.back() - times.front();
        t -= period * std::floor((time - times.front()) / period);
    }
    const auto after = std::ranges::upper_bound(times, t) - times.begin();
    if (after == 0) return {};
    const std::size_t i = after - 1;
    if (i + 1 == times.size()) return {i, i, 0};
    return {i, i + 1, (t - times[i]) / (times[i + 1] - times[i])};
}

}  // namespace magfsi::structure
