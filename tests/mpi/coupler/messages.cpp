// SPDX-License-Identifier: GPL-2.0-or-later
// A message of another coupled step ends the run on the side that receives it.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <chrono>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <thread>
#include "coupler/exchange/exchange.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/handshake.h"
#include "coupler/participants/waiting.h"
#include "coupler/participants/world.h"
#include "tests/mpi/coupler/split.h"
#include "tests/support/checks.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Small enough that every marker may meet every rank.
Grid small_grid(int fluid_ranks) {
    return cut_grid({8, 6, 8}, {true, true, true}, {1, fluid_ranks, 1});
}

std::vector<Vec3> one_marker() {
    return {{8e-4, 6e-4, 8e-4}};
}

TEST(OutOfStep, the_fluid_refuses_markers_of_another_step) {
    const World world(role_in(1), true);
    if (world.self() == Role::structure) {
        const Grid grid = small_grid(world.partner_size());
        StructureExchange exchange(world, grid, Kernel::three_point, timeout_s);
        send_first(exchange, one_marker());
        std::vector<Vec3> velocity(1);
        exchange.receive(-1, velocity);
        exchange.send(1, one_marker(), one_marker(), one_marker());
        MPI_Barrier(MPI_COMM_WORLD);
    } else {
        FluidExchange exchange(world, timeout_s);
        const auto& batch = exchange.receive(-1);
        EXPECT_EQ(batch.now_m.size(), 1u);
        exchange.send(-1, std::vector<Vec3>(1));
        test::expect_refusal<PartnerLost>(
            [&] { exchange.receive(0); },
            {"structure rank 0 carries step 1", "expected step 0"});
        MPI_Barrier(MPI_COMM_WORLD);
    }
}

TEST(OutOfStep, the_structure_refuses_velocities_of_another_step) {
    const World world(role_in(1), true);
    if (world.self() == Role::structure) {
        const Grid grid = small_grid(world.partner_size());
        StructureExchange exchange(world, grid, Kernel::three_point, timeout_s);
        send_first(exchange, one_marker());
        std::vector<Vec3> velocity(1);
        test::expect_refusal<PartnerLost>([&] { exchange.receive(-1, velocity); },
                                          {"fluid rank 0 carries step 6"});
        MPI_Barrier(MPI_COMM_WORLD);
    } else {
        FluidExchange exchange(world, timeout_s);
        exchange.receive(-1);
        exchange.send(6, std::vector<Vec3>(1));
        MPI_Barrier(MPI_COMM_WORLD);
    }
}

TEST(OutOfStep, probes_of_another_step_are_refused) {
    const World world(role_in(1), true);
    std::vector<double> numbers{1.5, 2.5};
    if (world.self() == Role::fluid) {
        if (world.root()) {
            send_numbers(world, 4, numbers, timeout_s);
            send_numbers(world, 5, numbers, timeout_s);
        }
        return;
    }
    std::vector<double> got(2);
    receive_numbers(world, 4, got, timeout_s);
    EXPECT_EQ(got, numbers);
    test::expect_refusal<PartnerLost>([&] { receive_numbers(world, 6, got, timeout_s); },
                                      {"step 5 came at step 6"});
}

// A partner that never answers is given up in the time set for it, and the wait leaves
// the core to others.
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
    const std::string why = test::message_of<PartnerLost>([&] {
        wait_all({&request, 1}, limit_s, "word of the partner");
    });
    const double counted_s = coupler::waited_s() - counted_before_s;
    const double waited_s = wall_s() - start;
    const double burnt_s = cpu_s() - cpu;
    cancel(request);
    test::expect_says(why, {"word of the partner", "0.4 s"});
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

// Looks at the partner are 20 ms apart: ten of them, and some for a busy machine. Short
// naps would be some hundred.
TEST(Wait, sleeps_until_the_partner_has_sent_something) {
    const World world(role_in(1), true);
    constexpr int tag = 3;
    const auto late = std::chrono::milliseconds(200);
    int number = 7;
    if (!world.root()) return;
    if (world.self() == Role::structure) {
        std::this_thread::sleep_for(late);
        MPI_Request request;
        world.send(&number, 1, MPI_INT, 0, tag, &request);
        wait_all({&request, 1}, timeout_s, "receiver");
        return;
    }
    rusage before{}, after{};
    getrusage(RUSAGE_THREAD, &before);
    int got = 0;
    world.receive_from_root(&got, 1, MPI_INT, tag, timeout_s, "number");
    getrusage(RUSAGE_THREAD, &after);
    EXPECT_EQ(got, number);
    EXPECT_LE(after.ru_nvcsw - before.ru_nvcsw, 40);
}

// The last message of a run reaches a partner that asks for it late, although the
// exchange that sent it has gone by then: at the end of the run, or taken by an
// exception.
// Half a megabyte: MPI keeps no copy of a message of this size.
constexpr std::size_t markers = 20'000;

// What takes the freed memory next, in which MPI goes on to serve the partner.
void live_on(const World& world) {
    const std::vector<std::vector<double>> later(
        16, std::vector<double>(message_header + marker_values * markers, 5.0));
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(600);
    while (std::chrono::steady_clock::now() < end) {
        int there = 0;
        MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, world.local(), &there, MPI_STATUS_IGNORE);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(later[7][markers], 5.0);
}

void ask_late() {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
}

const std::vector<Vec3> places(markers, Vec3{8e-4, 6e-4, 8e-4});

Grid grid_of(const World& world) {
    return cut_grid({8, 6, 8}, {true, true, true}, {1, world.partner_size(), 1});
}

void expect_velocities(const World& world) {
    const Grid grid = grid_of(world);
    StructureExchange exchange(world, grid, Kernel::three_point, timeout_s);
    send_first(exchange, places);
    ask_late();
    std::vector<Vec3> velocity(markers);
    exchange.receive(-1, velocity);
    const double ranks = world.partner_size();
    EXPECT_EQ(velocity, std::vector<Vec3>(markers, Vec3{ranks, ranks, ranks}));
}

TEST(LastMessage, outlives_the_exchange_that_sent_it) {
    const World world(role_in(1), true);
    if (world.self() == Role::structure) {
        expect_velocities(world);
    } else {
        auto exchange = std::make_unique<FluidExchange>(world, timeout_s);
        exchange->receive(-1);
        exchange->send(-1, std::vector<Vec3>(markers, Vec3{1, 1, 1}));
        exchange.reset();
        live_on(world);
    }
}

TEST(LastMessage, outlives_an_exception_of_the_fluid) {
    const World world(role_in(1), true);
    if (world.self() == Role::structure) {
        expect_velocities(world);
    } else {
        EXPECT_THROW(
            {
                FluidExchange exchange(world, timeout_s);
                exchange.receive(-1);
                exchange.send(-1, std::vector<Vec3>(markers, Vec3{1, 1, 1}));
                throw std::runtime_error("diverged");
            },
            std::runtime_error);
        live_on(world);
    }
}

TEST(LastMessage, outlives_an_exception_of_the_structure) {
    const World world(role_in(1), true);
    if (world.self() == Role::structure) {
        const Grid grid = grid_of(world);
        EXPECT_THROW(
            {
                StructureExchange exchange(world, grid, Kernel::three_point, timeout_s);
                exchange.send(-1, places, places, places);
                throw std::runtime_error("diverged");
            },
            std::runtime_error);
        live_on(world);
    } else {
        FluidExchange exchange(world, timeout_s);
        ask_late();
        EXPECT_EQ(exchange.receive(-1).impulse, places);
    }
}

}  // namespace
}  // namespace magfsi::coupler
