// SPDX-License-Identifier: GPL-2.0-or-later
// Seconds are computed from integer steps: no error gathers over a long run.
#include <gtest/gtest.h>
#include <chrono>
#include <stdexcept>
#include <thread>
#include "coupler/step/clock.h"
#include "coupler/step/load_balance.h"
#include "coupler/step/task_list.h"
#include "tests/support/checks.h"
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

// The coupled step as a list: its order, its names, its times.
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

// What has been called, in order.
struct Heard {
    bool wants_second = true;
    std::string calls{};
};

class Noted : public Output {
  public:
    Noted(Heard& heard, char name) : heard_(heard), name_(name) {}
    void begin() override { heard_.calls += {'b', name_, ' '}; }
    void end_step() override { heard_.calls += {'s', name_, ' '}; }
    void finish() override { heard_.calls += {'f', name_, ' '}; }

  private:
    Heard& heard_;
    char name_;
};

const OutputKind<Heard> kinds[] = {{"first", "write first",
                                    [](Heard& heard) -> std::unique_ptr<Output> {
                                        return std::make_unique<Noted>(heard, '1');
                                    }},
                                   {"second", "write second",
                                    [](Heard& heard) -> std::unique_ptr<Output> {
                                        if (!heard.wants_second) return nullptr;
                                        return std::make_unique<Noted>(heard, '2');
                                    }},
                                   {}};

class ListOfOutputs : public ::testing::Test {
  protected:
    void add() { outputs.add(kinds, heard, tasks); }

    Heard heard;
    TaskList tasks;
    Outputs outputs;
};

TEST_F(ListOfOutputs, act_in_the_order_of_their_list) {
    add();
    EXPECT_EQ(tasks.names(), "write first, write second");
    outputs.begin();
    tasks.run();
    outputs.finish();
    EXPECT_EQ(heard.calls, "b1 b2 s1 s2 f1 f2 ");
    EXPECT_EQ(outputs.probes(), nullptr);
}

TEST_F(ListOfOutputs, that_nobody_wants_have_no_task) {
    heard.wants_second = false;
    add();
    EXPECT_EQ(tasks.names(), "write first");
    outputs.begin();
    tasks.run();
    EXPECT_EQ(heard.calls, "b1 s1 ");
}

TEST_F(ListOfOutputs, that_the_build_lacks_are_refused_by_name) {
    add();
    EXPECT_NO_THROW(outputs.need(true, "second"));
    EXPECT_NO_THROW(outputs.need(false, "third"));
    EXPECT_EQ(
        test::message_of<std::invalid_argument>([&] { outputs.need(true, "third"); }),
        "third is asked for, and this program was built without it; leave its key out, "
        "or build the program with it");
}

// What a coupled run says about its own balance: the share that coupling costs, and the
// advice that it gives only where it pays.
SideLoad side(int ranks, double working_s, double waiting_s, int max_ranks) {
    SideLoad load;
    load.ranks = ranks;
    load.working_s = load.solver_s = working_s;
    load.waiting_s = waiting_s;
    load.max_ranks = max_ranks;
    return load;
}

std::string said(const SideLoad& structure, const SideLoad& fluid, double wall_s,
                 int cores) {
    return advice(structure, fluid, wall_s, cores).value_or("");
}

TEST(LoadBalance, overhead_is_what_neither_solver_needs) {
    SideLoad structure = side(1, 3, 6, 1);
    SideLoad fluid = side(1, 6, 3, 1);
    structure.steps_s = 12;  // two of them before the fluid's first step
    fluid.steps_s = 10;
    // 10 s in turns: 9 s of solvers.
    EXPECT_NEAR(coupling_overhead(structure, fluid), 0.1, 1e-12);
    // Both write at the same time: the longer output counts.
    structure.output_s = 0.2;
    fluid.output_s = 0.5;
    EXPECT_NEAR(coupling_overhead(structure, fluid), 0.05, 1e-12);
    // Markers and cells are work that the method asks for.
    fluid.immersed_boundary_s = 0.4;
    EXPECT_NEAR(coupling_overhead(structure, fluid), 0.01, 1e-12);
    EXPECT_NEAR(immersed_boundary_share(structure, fluid), 0.04, 1e-12);
    fluid.steps_s = 5;
    EXPECT_EQ(coupling_overhead(structure, fluid), 0);
}

TEST(LoadBalance, a_waiting_structure_is_told_to_give_the_fluid_more_ranks) {
    EXPECT_EQ(said(side(1, 1, 9, 1), side(1, 9, 1, 50), 10, 4),
              "the structure waited 90 % of the time for the fluid: "
              "--ranks structure=1,fluid=4 may be 3.1 times as fast");
}

TEST(LoadBalance, silent_where_nothing_pays) {
    // Every core is in use.
    EXPECT_EQ(said(side(1, 1, 9, 1), side(4, 9, 1, 50), 10, 4), "");
    // More ranks would have too little to do.
    EXPECT_EQ(said(side(1, 1, 9, 1), side(1, 9, 1, 1), 10, 4), "");
    // A tenth more is not worth it: the rest of the time is no side's work.
    EXPECT_EQ(said(side(1, 0, 9, 1), side(1, 2, 1, 50), 10, 2), "");
    // Too short to tell.
    EXPECT_EQ(said(side(1, .05, .4, 1), side(1, .4, .05, 50), 0.5, 4), "");
}

}  // namespace
}  // namespace magfsi::coupler
