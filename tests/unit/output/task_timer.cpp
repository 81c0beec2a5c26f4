#include "coupler/output/task_timer.h"

#include <gtest/gtest.h>

#include <cstdio>

using magfsi::output::steady_seconds;
using magfsi::output::TaskTimer;

TEST(TaskTimer, nested_tasks_count_once) {
    double now_s = 100;
    TaskTimer timer([&] { return now_s; });
    {
        const auto step = timer.measure("step");
        now_s += 1;
        {
            const auto exchange = timer.measure("exchange");
            now_s += 4;
        }
        now_s += 2;
    }
    now_s += 50;  // outside all tasks
    {
        const auto again = timer.measure("exchange");
        now_s += 8;
    }
    ASSERT_EQ(timer.seconds().size(), 2u);
    EXPECT_EQ(timer.seconds()[0], (std::pair<std::string, double>{"step", 3}));
    EXPECT_EQ(timer.seconds()[1], (std::pair<std::string, double>{"exchange", 12}));
}

TEST(TaskTimer, a_guard_costs_less_than_ten_microseconds) {
    TaskTimer timer;
    const int guards = 100000;
    const double start_s = steady_seconds();
    for (int i = 0; i < guards; ++i) const auto guard = timer.measure("task");
    const double wall_s = steady_seconds() - start_s;
    std::printf("one guard: %.3f us\n", 1e6 * wall_s / guards);
    // About 0.1 us on an idle core; a step of the smallest coupled run is 1 ms with ten
    // guards, and 10 us leave room for a sanitizer and a busy machine.
    EXPECT_LT(wall_s / guards, 10e-6);
    EXPECT_LE(timer.seconds()[0].second, wall_s);  // tasks never exceed the wall time
}
