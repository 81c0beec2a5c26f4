// The coupled step as a list: its order, its names, its times.
#include "coupler/step/task_list.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace magfsi::coupler {
namespace {

TEST(TaskList, runs_in_the_order_of_adding_every_time) {
    TaskList tasks;
    std::string ran;
    tasks.add("advance", [&] { ran += 'a'; });
    tasks.add("send", [&] { ran += 's'; });
    tasks.add("wait", [&] { ran += 'w'; });
    tasks.run();
    tasks.run();
    EXPECT_EQ(ran, "aswasw");
    EXPECT_EQ(tasks.names(), "advance, send, wait");
}

TEST(TaskList, repeats_a_part_as_long_as_it_is_told_to) {
    TaskList tasks;
    std::string ran;
    int left = 0;
    tasks.add("keep", [&] {
        ran += 'k';
        left = 2;
    });
    const std::size_t first = tasks.size();
    tasks.add("guess", [&] { ran += 'g'; });
    tasks.add("judge", [&] { ran += 'j'; });
    tasks.repeat_from(first, [&] { return left-- > 0; });
    tasks.add("accept", [&] { ran += 'a'; });
    tasks.run();
    tasks.run();
    EXPECT_EQ(ran, "kgjgjgjakgjgjgja");
    EXPECT_EQ(tasks.names(), "keep, repeat (guess, judge), accept");
}

TEST(TaskList, repeats_from_the_very_first) {
    TaskList tasks;
    int ran = 0;
    tasks.add("only", [&] { ++ran; });
    tasks.repeat_from(0, [&] { return ran < 3; });
    tasks.run();
    EXPECT_EQ(ran, 3);
    EXPECT_EQ(tasks.names(), "repeat (only)");
}

TEST(TaskList, no_task_no_name) {
    TaskList tasks;
    tasks.run();
    EXPECT_EQ(tasks.names(), "");
    EXPECT_TRUE(tasks.times().empty());
}

TEST(TaskList, times_each_task_under_its_name) {
    using namespace std::chrono;
    TaskList tasks;
    tasks.add("sleep", [] { std::this_thread::sleep_for(milliseconds(10)); });
    tasks.add("nothing", [] {});
    const auto start = steady_clock::now();
    tasks.run();
    tasks.run();
    const double wall_s = duration<double>(steady_clock::now() - start).count();
    const auto times = tasks.times();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].name, "sleep");
    EXPECT_EQ(times[1].name, "nothing");
    EXPECT_GE(times[0].seconds, 0.02);  // sleep_for never returns early
    EXPECT_GT(times[0].seconds, times[1].seconds);
    EXPECT_LE(times[0].seconds + times[1].seconds, wall_s);
    EXPECT_EQ(tasks.seconds("sleep"), times[0].seconds);
    EXPECT_EQ(tasks.seconds("another"), 0);
}

TEST(TaskList, a_task_that_throws_ends_the_step) {
    TaskList tasks;
    bool reached = false;
    tasks.add("fail", [] { throw std::runtime_error("no"); });
    tasks.add("after", [&] { reached = true; });
    EXPECT_THROW(tasks.run(), std::runtime_error);
    EXPECT_FALSE(reached);
}

}  // namespace
}  // namespace magfsi::coupler
