// A message of another coupled step ends the run on the side that receives it.
#include <gtest/gtest.h>

#include "coupler/exchange/exchange.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/world.h"
#include "tests/mpi/coupler/split.h"
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

template <typename Receive>
std::string refusal(Receive receive) {
    try {
        receive();
    } catch (const PartnerLost& e) {
        return e.what();
    }
    return "accepted";
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
        const std::string why = refusal([&] { exchange.receive(0); });
        EXPECT_NE(why.find("structure rank 0 carries step 1"), std::string::npos) << why;
        EXPECT_NE(why.find("expected step 0"), std::string::npos) << why;
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
        const std::string why = refusal([&] { exchange.receive(-1, velocity); });
        EXPECT_NE(why.find("fluid rank 0 carries step 6"), std::string::npos) << why;
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
    const std::string why = refusal([&] { receive_numbers(world, 6, got, timeout_s); });
    EXPECT_NE(why.find("step 5 came at step 6"), std::string::npos) << why;
}

}  // namespace
}  // namespace magfsi::coupler
