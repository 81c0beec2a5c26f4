// SPDX-License-Identifier: GPL-2.0-or-later
// The audit of the interface sees what it is there for.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupler/immersed_boundary/balance.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

// Six numbers a step: impulse, work, scale of impulse, scale of work.
std::vector<double> three_steps() {
    return {1e-9, 2e-9, -1e-9, 3e-10, 5e-9, 8e-10,  //
            4e-9, 0,    2e-9,  1e-10, 7e-9, 9e-10,  //
            0,    0,    0,     0,     0,    0};
}

TEST(InterfaceBalance, equal_sides_do_not_differ) {
    const auto worst = worst_mismatch(three_steps(), three_steps());
    EXPECT_EQ(worst.momentum, 0);
    EXPECT_EQ(worst.power, 0);
}

TEST(InterfaceBalance, finds_a_billionth_in_either_step) {
    for (const std::size_t step : {0u, 1u}) {
        auto received = three_steps();
        const std::size_t at = step * balance_values;
        received[at + 2] += 1e-9 * received[at + 4];
        received[at + 3] -= 1e-9 * received[at + 5];
        const auto worst = worst_mismatch(three_steps(), received);
        // The difference of numbers of the scale's order keeps seven digits of 1e-9.
        EXPECT_NEAR(worst.momentum, 1e-9, 1e-15) << "step " << step;
        EXPECT_NEAR(worst.power, 1e-9, 1e-15) << "step " << step;
    }
}

TEST(InterfaceBalance, momentum_from_nowhere_has_no_scale_and_no_excuse) {
    auto received = three_steps();
    received[2 * balance_values + 1] = 1e-30;  // the body gave nothing in the third step
    EXPECT_TRUE(std::isinf(worst_mismatch(three_steps(), received).momentum));
    received = three_steps();
    received[2 * balance_values + 3] = -1e-30;
    EXPECT_TRUE(std::isinf(worst_mismatch(three_steps(), received).power));
}

TEST(InterfaceBalance, a_nan_is_the_worst_mismatch) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::size_t value : {0u, 3u}) {
        auto received = three_steps();
        received[value] = nan;
        const auto worst = worst_mismatch(three_steps(), received);
        EXPECT_TRUE(std::isinf(value == 0 ? worst.momentum : worst.power)) << value;
        const auto given = worst_mismatch(received, three_steps());
        EXPECT_TRUE(std::isinf(value == 0 ? given.momentum : given.power)) << value;
    }
}

TEST(InterfaceBalance, marker_sums) {
    InterfaceBalance sum;
    add_marker(sum, {3, -4, 0}, {2, 1, 7});
    add_marker(sum, {-3, 4, 0}, {1, 1, 7});
    EXPECT_EQ(sum.impulse_n_s, (Vec3{0, 0, 0}));
    EXPECT_DOUBLE_EQ(sum.work_j, (6 - 4) + (-3 + 4));
    EXPECT_DOUBLE_EQ(sum.impulse_scale_n_s, 10);
    EXPECT_DOUBLE_EQ(sum.work_scale_j, (6 + 4) + (3 + 4));
}

}  // namespace
}  // namespace magfsi::coupler
