// Seconds are computed from integer steps: no error gathers over a long run.
#include "coupler/step/clock.h"

#include <gtest/gtest.h>

#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

TEST(Clock, ten_million_steps_gather_no_error) {
    const double step_s = 1.7e-5;
    Clock clock(step_s, 170);
    ASSERT_EQ(clock.steps(), 10'000'000);
    double accumulated = 0;
    while (!clock.done()) {
        clock.tick();
        accumulated += step_s;
    }
    EXPECT_EQ(clock.step(), 10'000'000);
    EXPECT_EQ(clock.time_s(), 1e7 * step_s);
    EXPECT_NE(accumulated, 1e7 * step_s);  // what the clock avoids
}

// An end of n steps is n steps, though the quotient end / step is rounded; beyond 1e7 its
// last place is larger than any fixed tolerance would allow for.
TEST(Clock, an_end_of_whole_steps_takes_no_extra_step) {
    testing::Random random(41);
    for (const std::int64_t steps :
         {1LL, 3LL, 1000LL, 99'999LL, 10'000'000LL, 3'000'000'001LL}) {
        for (int trial = 0; trial < 2000; ++trial) {
            const double step_s = random.between(1e-6, 1e-4);
            const double end_s = static_cast<double>(steps) * step_s;
            ASSERT_EQ(Clock(step_s, end_s).steps(), steps) << step_s;
        }
    }
}

TEST(Clock, runs_to_the_first_step_at_or_after_the_end) {
    EXPECT_EQ(Clock(2e-5, 1e-4).steps(), 5);
    EXPECT_EQ(Clock(2e-5, 1.01e-4).steps(), 6);
    EXPECT_EQ(Clock(2e-5, 0.99e-4).steps(), 5);
    EXPECT_EQ(Clock(2e-5, 1e-9).steps(), 1);
    EXPECT_EQ(Clock(2e-5, 0).steps(), 0);
    EXPECT_TRUE(Clock(2e-5, 0).done());
}

TEST(Clock, every_is_the_nearest_whole_number_of_steps_and_never_none) {
    const Clock clock(2e-5, 1);
    EXPECT_EQ(clock.every(1e-3), 50);
    EXPECT_EQ(clock.every(2e-5), 1);
    EXPECT_EQ(clock.every(5.1e-5), 3);
    EXPECT_EQ(clock.every(1e-9), 1);
    EXPECT_EQ(clock.every(0), 1);
}

}  // namespace
}  // namespace magfsi::coupler
