// Told to end, a participant does not wait for its partner any longer. The flag stays
// set: a program of its own.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>

#include "coupler/participants/errors.h"
#include "coupler/participants/world.h"
#include "tests/mpi/coupler/split.h"

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
    std::string why = "no exception";
    try {
        wait_all({&request, 1}, testing::timeout_s, "word of the partner");
    } catch (const Stopped& e) {
        why = e.what();
    }
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    MPI_Cancel(&request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    EXPECT_NE(why.find("signal 15"), std::string::npos) << why;
    EXPECT_NE(why.find("word of the partner"), std::string::npos) << why;
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

}  // namespace
}  // namespace magfsi::coupler
