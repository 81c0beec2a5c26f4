// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace magfsi::lammps {
namespace {

using limits = std::numeric_limits<double>;

TEST(AllFinite, of_the_largest_and_the_smallest_numbers) {
    EXPECT_TRUE(all_finite({}));
    const std::vector<double> numbers{0,
                                      -0.0,
                                      1,
                                      -1,
                                      limits::max(),
                                      limits::lowest(),
                                      limits::denorm_min(),
                                      -limits::min()};
    EXPECT_TRUE(all_finite(numbers));
}

TEST(AllFinite, sees_one_fault_anywhere) {
    const std::vector<double> faults{limits::infinity(), -limits::infinity(),
                                     limits::quiet_NaN(), -limits::quiet_NaN(),
                                     limits::signaling_NaN()};
    for (const double fault : faults) {
        for (std::size_t place = 0; place < 19; ++place) {
            std::vector<double> numbers(19, limits::max());
            numbers[place] = fault;
            EXPECT_FALSE(all_finite(numbers)) << fault << " at " << place;
        }
    }
}

}  // namespace
}  // namespace magfsi::lammps
