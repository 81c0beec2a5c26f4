// A partner that never answers is given up in the time set for it, and the wait leaves
// the core to others.
#include <gtest/gtest.h>

#include <chrono>
#include <ctime>

#include "coupler/participants/errors.h"
#include "coupler/participants/world.h"
#include "tests/mpi/coupler/split.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

double wall_s() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

double cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void cancel(MPI_Request& request) {
    MPI_Cancel(&request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
}

TEST(WaitTimeout, a_message_that_never_comes) {
    const World world(role_in(1), true);
    double never = 0;
    MPI_Request request;
    MPI_Irecv(&never, 1, MPI_DOUBLE, 0, 1, world.partner(), &request);
    const double limit_s = 0.4;
    const double start = wall_s();
    const double cpu = cpu_s();
    const double counted_before_s = coupler::waited_s();
    std::string why = "no exception";
    try {
        wait_all({&request, 1}, limit_s, "word of the partner");
    } catch (const PartnerLost& e) {
        why = e.what();
    }
    const double counted_s = coupler::waited_s() - counted_before_s;
    const double waited_s = wall_s() - start;
    const double burnt_s = cpu_s() - cpu;
    cancel(request);
    EXPECT_NE(why.find("word of the partner"), std::string::npos) << why;
    EXPECT_NE(why.find("0.4 s"), std::string::npos) << why;
    EXPECT_GE(waited_s, limit_s);
    // The wait counts as waiting, though it ended in an exception.
    EXPECT_GE(counted_s, limit_s);
    EXPECT_LE(counted_s, waited_s);
    // A look every 200 us; the rest is what a busy machine takes to wake a sleeper.
    EXPECT_LE(waited_s, limit_s + 2);
    // A wait that spins would burn all of it, alone on its core.
    EXPECT_LE(burnt_s, 0.5 * waited_s);
    if (world_rank() == 0) {
        std::printf("limit %.1f s: waited %.4f s, %.4f s of it on the core\n", limit_s,
                    waited_s, burnt_s);
    }
}

TEST(WaitTimeout, what_has_come_is_not_late) {
    const World world(role_in(1), true);
    const int mine = 7;
    int theirs = 0;
    std::vector<MPI_Request> requests;
    if (world.root()) {
        MPI_Irecv(&theirs, 1, MPI_INT, 0, 2, world.partner(), &requests.emplace_back());
        MPI_Isend(&mine, 1, MPI_INT, 0, 2, world.partner(), &requests.emplace_back());
    }
    EXPECT_NO_THROW(wait_all(requests, timeout_s, "number"));
    EXPECT_EQ(theirs, world.root() ? 7 : 0);
    // Nothing to wait for is over at once, whatever the limit.
    EXPECT_NO_THROW(wait_all({}, 0, "nothing"));
}

}  // namespace
}  // namespace magfsi::coupler
