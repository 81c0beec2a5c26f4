// SPDX-License-Identifier: GPL-2.0-or-later
// The conditions that define the delta kernels (Peskin 2002, section 6; Roma et al.
// 1999).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Four weights of order one, each rounded once or twice.
constexpr double rounding = 2e-15;

std::vector<double> positions() {
    std::vector<double> all;
    for (int quarter = 12; quarter < 400; ++quarter) all.push_back(0.25 * quarter);
    Random random(7);
    for (int i = 0; i < 20000; ++i) all.push_back(random.between(3, 100));
    return all;
}

double weight(const Stencil1D& s, int k) {
    return s.weight[static_cast<std::size_t>(k)];
}

TEST(DeltaKernel, partition_of_unity) {
    for (const Kernel kernel : all_kernels) {
        for (const double x : positions()) {
            const Stencil1D s = stencil_1d(kernel, x);
            double sum = 0;
            for (int k = 0; k < s.count; ++k) sum += weight(s, k);
            ASSERT_NEAR(sum, 1, rounding) << support(kernel) << " points at " << x;
        }
    }
}

TEST(DeltaKernel, first_moment_vanishes) {
    for (const Kernel kernel : all_kernels) {
        for (const double x : positions()) {
            const Stencil1D s = stencil_1d(kernel, x);
            double moment = 0;
            for (int k = 0; k < s.count; ++k)
                moment += (s.first + k + 0.5 - x) * weight(s, k);
            ASSERT_NEAR(moment, 0, rounding) << support(kernel) << " points at " << x;
        }
    }
}

TEST(DeltaKernel, stencil_holds_every_cell_of_the_support) {
    for (const Kernel kernel : all_kernels) {
        for (const double x : positions()) {
            const Stencil1D s = stencil_1d(kernel, x);
            for (int cell = static_cast<int>(x) - 5; cell < x + 5; ++cell) {
                const int k = cell - s.first;
                const double found = k >= 0 && k < s.count ? weight(s, k) : 0;
                ASSERT_NEAR(found, delta(kernel, x - 0.5 - cell), rounding) << x;
            }
        }
    }
}

TEST(DeltaKernel, four_point_gives_even_and_odd_cells_a_half_each) {
    for (const double x : positions()) {
        const Stencil1D s = stencil_1d(Kernel::four_point, x);
        ASSERT_NEAR(weight(s, 0) + weight(s, 2), 0.5, rounding) << x;
        ASSERT_NEAR(weight(s, 1) + weight(s, 3), 0.5, rounding) << x;
    }
}

// The self-interaction of a marker does not depend on where it sits between the cells.
TEST(DeltaKernel, sum_of_squares_is_the_same_everywhere) {
    for (const auto& [kernel, expected] :
         {std::pair{Kernel::three_point, 1.0 / 2}, {Kernel::four_point, 3.0 / 8}}) {
        for (const double x : positions()) {
            const Stencil1D s = stencil_1d(kernel, x);
            double sum = 0;
            for (const double w : s.weight) sum += w * w;
            ASSERT_NEAR(sum, expected, rounding) << support(kernel) << " points at " << x;
        }
    }
}

}  // namespace
}  // namespace magfsi::coupler
