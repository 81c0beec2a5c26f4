// SPDX-License-Identifier: GPL-2.0-or-later
// Told to end, a participant does not wait for its partner any longer. The flag stays
// set: a program of its own.
#include <gtest/gtest.h>
#include <chrono>
#include <csignal>
#include "coupler/checkpoint/checkpoints.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/waiting.h"
#include "coupler/participants/world.h"
#include "tests/mpi/coupler/split.h"
#include "tests/support/checks.h"

namespace magfsi::coupler {
namespace {

TEST(StopSignal, ends_a_wait_long_before_its_timeout) {
    const World world(testing::role_in(1), true);
    catch_stop_signals();
    EXPECT_EQ(stop_requested(), 0);
    std::raise(SIGTERM);
    EXPECT_EQ(stop_requested(), SIGTERM);

    double never = 0;
    MPI_Request request;
    MPI_Irecv(&never, 1, MPI_DOUBLE, 0, 1, world.partner(), &request);
    const auto start = std::chrono::steady_clock::now();
    const std::string why = test::message_of<Stopped>([&] {
        wait_all({&request, 1}, testing::timeout_s, "word of the partner");
    });
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    MPI_Cancel(&request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    test::expect_says(why, {"signal 15", "word of the partner"});
    EXPECT_LT(waited.count(), 0.1 * testing::timeout_s);
}

// A message that is there is taken first: the step that it belongs to can be completed.
TEST(StopSignal, does_not_lose_a_message_that_came) {
    const World world(testing::role_in(1), true);
    ASSERT_EQ(stop_requested(), SIGTERM);
    int self = world.rank();
    int got = -1;
    MPI_Request requests[2];
    MPI_Irecv(&got, 1, MPI_INT, world.rank(), 3, world.local(), &requests[0]);
    MPI_Isend(&self, 1, MPI_INT, world.rank(), 3, world.local(), &requests[1]);
    EXPECT_NO_THROW(wait_all(requests, testing::timeout_s, "own message"));
    EXPECT_EQ(got, world.rank());
}

// A signal that reaches one rank at any step ends all ranks of both sides after the same
// coupled step, and the step loop of neither waits for the other side's signal. The flag
// stays set: a program of its own.
constexpr std::int64_t steps = 20;

// The step after which this rank ends; steps when nobody told it to.
std::int64_t last_step(const World& world, int told_world_rank, std::int64_t told_at) {
    StopAgreement stop(world, testing::timeout_s);
    for (std::int64_t step = 1; step <= steps; ++step) {
        if (testing::world_rank() == told_world_rank && step == told_at)
            std::raise(SIGUSR1);
        if (stop.reached(step, step == steps)) return step;
    }
    return steps;
}

TEST(StopTogether, without_a_signal_all_run_to_the_end) {
    const World world(testing::role_in(1), true);
    catch_stop_signals();
    postpone_stop();
    EXPECT_EQ(last_step(world, -1, 0), steps);
}

// A wait goes on where the scene has checkpoints: the step can be completed.
TEST(StopTogether, one_step_after_the_structure_was_told) {
    const World world(testing::role_in(1), true);
    ASSERT_EQ(stop_requested(), 0);
    const std::int64_t mine = last_step(world, 0, 7);
    EXPECT_EQ(mine, 8);
    std::int64_t first = mine;
    std::int64_t last = mine;
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT64_T, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &last, 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_EQ(first, last);
}

}  // namespace
}  // namespace magfsi::coupler
