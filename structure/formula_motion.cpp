// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/formula_motion.h"

#include <algorithm>

namespace magfsi::structure {

namespace {

// By differences of five points: to 1e-6 of an oscillation of 1 kHz. Formulas need no
// value before time 0, so that the start has that of 20 us later.
constexpr double apart_s = 1e-5;

Vec3 difference(const FormulaMotion& f, double time_s,
                const std::array<double, 5>& weight, double scale) {
    Vec3 sum{};
    const double middle_s = std::max(time_s, 2 * apart_s);
    for (int i = -2; i <= 2; ++i) {
        const Vec3 there = value_at(f.component_m, middle_s + i * apart_s);
        for (std::size_t d = 0; d < 3; ++d)
            sum[d] += weight[static_cast<std::size_t>(i + 2)] * there[d] / scale;
    }
    return sum;
}

}  // namespace

Vec3 displacement(const FormulaMotion& f, double time_s) {
    Vec3 out = value_at(f.component_m, time_s);
    const Vec3 start = value_at(f.component_m, 0);
    for (std::size_t d = 0; d < 3; ++d) out[d] -= start[d];
    return out;
}

Vec3 velocity(const FormulaMotion& f, double time_s) {
    return difference(f, time_s, {1, -8, 0, 8, -1}, 12 * apart_s);
}

Vec3 acceleration(const FormulaMotion& f, double time_s) {
    return difference(f, time_s, {-1, 16, -30, 16, -1}, 12 * apart_s * apart_s);
}

}  // namespace magfsi::structure
