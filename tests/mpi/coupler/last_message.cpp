// The last velocities of a run reach a structure rank that asks for them late, although
// the fluid's exchange has gone by then.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

#include "coupler/exchange/fluid_exchange.h"
#include "coupler/exchange/structure_exchange.h"
#include "tests/mpi/coupler/split.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Half a megabyte: MPI keeps no copy of a message of this size.
constexpr std::size_t markers = 20'000;

TEST(LastMessage, outlives_the_exchange_that_sent_it) {
    const World world(role_in(1), true);
    if (world.self() == Role::structure) {
        const Grid grid =
            cut_grid({8, 6, 8}, {true, true, true}, {1, world.partner_size(), 1});
        StructureExchange exchange(world, grid, Kernel::three_point, timeout_s);
        exchange.send_first(std::vector<Vec3>(markers, Vec3{8e-4, 6e-4, 8e-4}));
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        std::vector<Vec3> velocity(markers);
        exchange.receive(-1, velocity);
        const double ranks = world.partner_size();
        EXPECT_EQ(velocity.front(), (Vec3{ranks, ranks, ranks}));
        EXPECT_EQ(velocity[markers / 2], (Vec3{ranks, ranks, ranks}));
        EXPECT_EQ(velocity.back(), (Vec3{ranks, ranks, ranks}));
    } else {
        auto exchange = std::make_unique<FluidExchange>(world, timeout_s);
        exchange->receive(-1);
        exchange->send(-1, std::vector<Vec3>(markers, Vec3{1, 1, 1}));
        exchange.reset();
        // What takes the freed memory next.
        const std::vector<std::vector<double>> later(
            8, std::vector<double>(3 * markers + 2, 5.0));
        MPI_Barrier(world.local());
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        EXPECT_EQ(later[7][markers], 5.0);
    }
}

}  // namespace
}  // namespace magfsi::coupler
