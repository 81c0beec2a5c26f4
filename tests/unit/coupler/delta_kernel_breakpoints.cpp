// The kernels are pieced together: no jump and no NaN where the pieces meet.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using testing::all_kernels;

// Slopes are at most 1 and a step of one last place is at most 4e-16: values on both
// sides differ by rounding alone.
constexpr double rounding = 2e-15;

TEST(DeltaKernel, continuous_at_breakpoints) {
    for (const Kernel kernel : all_kernels) {
        for (const double r : {0.0, 0.5, 1.0, 1.5, 2.0}) {
            const double before = delta(kernel, std::nextafter(r, -1.0));
            const double at = delta(kernel, r);
            const double after = delta(kernel, std::nextafter(r, 3.0));
            EXPECT_NEAR(before, at, rounding) << support(kernel) << " points at " << r;
            EXPECT_NEAR(after, at, rounding) << support(kernel) << " points at " << r;
        }
    }
}

TEST(DeltaKernel, known_values) {
    EXPECT_DOUBLE_EQ(delta(Kernel::two_point, 0), 1);
    EXPECT_DOUBLE_EQ(delta(Kernel::two_point, 0.5), 0.5);
    EXPECT_DOUBLE_EQ(delta(Kernel::three_point, 0), 2.0 / 3);
    EXPECT_DOUBLE_EQ(delta(Kernel::three_point, 0.5), 0.5);
    EXPECT_DOUBLE_EQ(delta(Kernel::three_point, 1), 1.0 / 6);
    EXPECT_DOUBLE_EQ(delta(Kernel::four_point, 0), 0.5);
    EXPECT_DOUBLE_EQ(delta(Kernel::four_point, 1), 0.25);
    EXPECT_DOUBLE_EQ(delta(Kernel::four_point, 0.5), (2 + std::sqrt(2)) / 8);
}

TEST(DeltaKernel, zero_from_the_edge_of_the_support_on) {
    for (const Kernel kernel : all_kernels) {
        const double edge = 0.5 * support(kernel);
        for (const double r : {edge, edge + 1e-12, edge + 0.5, edge + 10}) {
            EXPECT_EQ(delta(kernel, r), 0) << support(kernel) << " points at " << r;
        }
    }
}

TEST(DeltaKernel, even_and_never_negative_or_nan) {
    for (const Kernel kernel : all_kernels) {
        for (int i = 0; i <= 250000; ++i) {
            const double r = 1e-5 * i;
            const double value = delta(kernel, r);
            ASSERT_EQ(value, delta(kernel, -r)) << r;
            // The three-point outer piece cancels to zero at 1.5: rounding may cross it.
            ASSERT_GE(value, -1e-16) << support(kernel) << " points at " << r;
        }
        for (const double r : {0.5, 1.0, 1.5, 2.0}) {
            for (const double x : {r, std::nextafter(r, 0.0), std::nextafter(r, 3.0)}) {
                EXPECT_TRUE(std::isfinite(delta(kernel, x)))
                    << support(kernel) << " at " << x;
            }
        }
    }
}

}  // namespace
}  // namespace magfsi::coupler
