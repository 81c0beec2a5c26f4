// The last message of a run reaches a partner that asks for it late, although the
// exchange that sent it has gone by then: at the end of the run, or taken by an
// exception.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include "coupler/exchange/exchange.h"
#include "tests/mpi/coupler/split.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

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
