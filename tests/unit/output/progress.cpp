#include "coupler/output/log.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace magfsi::output;

namespace {

// 200 steps to 0.04 s, on a clock that the test sets.
struct Rehearsal {
    explicit Rehearsal(ProgressMode mode, std::int64_t first_step = 0)
        : progress(
              mode, {200, 0.04, first_step},
              [this](std::string_view text) { given.emplace_back(text); },
              [this] { return now_s; }) {}

    void advance(std::int64_t step, double seconds) {
        now_s = 1000 + seconds;
        progress.update(step);
    }

    double now_s = 1000;
    std::vector<std::string> given;
    Progress progress;
};

using Lines = std::vector<std::string>;

}  // namespace

TEST(Progress, plain_lines_come_at_the_marks) {
    Rehearsal run(ProgressMode::plain);
    for (int step = 1; step <= 24; ++step) run.advance(step, 20.0 * step);
    EXPECT_EQ(run.given,
              (Lines{"  1 %   0.0004 of 0.04 s   0.05 steps/s   1:06:00 left",
                     "  5 %   0.002 of 0.04 s   0.05 steps/s   1:03:20 left",
                     " 10 %   0.004 of 0.04 s   0.05 steps/s   1:00:00 left"}));
}

TEST(Progress, plain_lines_keep_ten_seconds_apart) {
    Rehearsal run(ProgressMode::plain);
    for (int step = 1; step <= 200; ++step) run.advance(step, 0.125 * step);
    run.progress.finish(200);
    EXPECT_EQ(run.given, (Lines{" 40 %   0.016 of 0.04 s   8 steps/s   0:15 left",
                                " 80 %   0.032 of 0.04 s   8 steps/s   0:05 left",
                                "100 %   0.04 of 0.04 s   8 steps/s   0:00 left"}));
}

TEST(Progress, the_terminal_line_is_rewritten_and_the_longer_one_wiped) {
    Rehearsal run(ProgressMode::terminal);
    run.advance(1, 0.1);  // sooner than anyone can read
    EXPECT_TRUE(run.given.empty());
    run.advance(7, 0.5);
    run.advance(50, 1.0);
    ASSERT_EQ(run.given.size(), 2u);
    EXPECT_EQ(run.given[0], "\r  3 %   0.0014 of 0.04 s   14 steps/s   0:14 left");
    EXPECT_EQ(run.given[1], "\r 25 %   0.01 of 0.04 s   50 steps/s   0:03 left  ");
    run.progress.clear();
    EXPECT_EQ(run.given.back(), "\r" + std::string(47, ' ') + "\r");
    run.progress.finish(200);
    EXPECT_EQ(run.given.back(), "\n");
}

TEST(Progress, after_a_restart_only_new_steps_count_for_the_rate) {
    Rehearsal run(ProgressMode::plain, 100);
    run.advance(150, 25);
    EXPECT_EQ(run.given, (Lines{" 75 %   0.03 of 0.04 s   2 steps/s   0:25 left"}));
}

TEST(Progress, off_says_nothing) {
    Rehearsal run(ProgressMode::off);
    run.advance(100, 100);
    run.progress.finish(200);
    EXPECT_TRUE(run.given.empty());
}

TEST(Progress, before_the_first_step_the_time_left_is_not_known) {
    Rehearsal run(ProgressMode::plain);
    EXPECT_EQ(run.progress.line(0, 1000), "  0 %   0 of 0.04 s   0 steps/s   ? left");
}
