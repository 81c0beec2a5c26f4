// The exchange between any number of structure and fluid ranks gives what one rank of
// each would compute: velocities, forces, momentum and power, in every coupled step.
#include <gtest/gtest.h>

#include <algorithm>

#include "coupler/exchange/exchange.h"
#include "coupler/participants/world.h"
#include "tests/mpi/coupler/split.h"
#include "tests/mpi/coupler/travelling_markers.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Velocities are of order one; shares and forces are added in another order, 40 times.
constexpr double rounding = 1e-13;

// The markers of structure rank `rank`, chosen from values of all.
using Owner = int (*)(std::size_t marker, int structure_ranks);

std::vector<Vec3> own(const std::vector<Vec3>& all, const World& world, Owner owner) {
    std::vector<Vec3> mine;
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (owner(m, world.size()) == world.rank()) mine.push_back(all[m]);
    }
    return mine;
}

double worst_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double worst = a.size() == b.size() ? 0 : 1;
    for (std::size_t m = 0; m < a.size(); ++m)
        for (std::size_t d = 0; d < 3; ++d)
            worst = std::max(worst, std::abs(a[m][d] - b[m][d]));
    return worst;
}

void run_structure(const World& world, Owner owner) {
    const Grid grid = channel(world.partner_size());
    const TravellingMarkers markers(grid.spacing_m);
    const auto expected = velocities_on_one_rank();
    const auto mine = [&](const std::vector<Vec3>& all) {
        return own(all, world, owner);
    };
    StructureExchange exchange(world, grid, kernel, timeout_s);
    BalanceRecord given;

    std::vector<Vec3> velocity(mine(markers.positions(0)).size());
    send_first(exchange, mine(markers.positions(0)));
    exchange.receive(-1, velocity);
    double worst = worst_difference(velocity, mine(expected[0]));
    int least = exchange.partners();
    int most = exchange.partners();
    for (std::int64_t step = 0; step < coupled_steps; ++step) {
        const auto impulse = mine(markers.impulses(step));
        InterfaceBalance balance;
        for (std::size_t m = 0; m < impulse.size(); ++m) {
            add_marker(balance, impulse[m], velocity[m]);
        }
        given.add(balance);
        exchange.send(step, mine(markers.positions(step)), impulse,
                      mine(markers.positions(step + 1)));
        exchange.receive(step, velocity);
        worst = std::max(
            worst, worst_difference(velocity,
                                    mine(expected[static_cast<std::size_t>(step + 1)])));
        least = std::min(least, exchange.partners());
        most = std::max(most, exchange.partners());
    }
    EXPECT_LE(worst, rounding);
    // The cloud is small: at times some ranks are out of its reach and get no message.
    if (world.partner_size() > 1 && !velocity.empty()) {
        EXPECT_LT(least, world.partner_size());
    }
    EXPECT_EQ(most > 0, !velocity.empty());

    const auto sums = given.collect(world.local());
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, world.local());
    if (!world.root()) return;
    std::vector<double> received(sums.size());
    receive_numbers(world, coupled_steps, received, timeout_s);
    const Mismatch mismatch = worst_mismatch(sums, received);
    std::printf(
        "%d + %d ranks: velocity %.1e m/s, momentum %.1e, power %.1e, partners %d to "
        "%d\n",
        world.size(), world.partner_size(), worst, mismatch.momentum, mismatch.power,
        least, most);
    EXPECT_EQ(sums.size(), coupled_steps * balance_values);
    EXPECT_LE(mismatch.momentum, rounding);
    EXPECT_LE(mismatch.power, rounding);
}

// The force on the cells of all ranks is the sum of the impulses over the step.
void expect_all_force(const World& world, const ArrayFluid& fluid,
                      const std::vector<Vec3>& impulses) {
    Vec3 force = fluid.total_force();
    MPI_Allreduce(MPI_IN_PLACE, force.data(), 3, MPI_DOUBLE, MPI_SUM, world.local());
    for (std::size_t d = 0; d < 3; ++d) {
        double sum = 0;
        double scale = 0;
        for (const Vec3& j : impulses) {
            sum += j[d] / ArrayFluid::step_s;
            scale += std::abs(j[d]) / ArrayFluid::step_s;
        }
        EXPECT_NEAR(force[d], sum, rounding * scale) << "axis " << d;
    }
}

void run_fluid(const World& world) {
    const Grid grid = channel(world.size());
    const TravellingMarkers markers(grid.spacing_m);
    ArrayFluid fluid(grid, world.rank());
    FluidSide side(fluid, grid.owned_by_rank[static_cast<std::size_t>(world.rank())],
                   kernel, ArrayFluid::step_s);
    FluidExchange exchange(world, timeout_s);
    BalanceRecord received;

    exchange.send(-1, side.sample(exchange.receive(-1).now_m));
    for (std::int64_t step = 0; step < coupled_steps; ++step) {
        const MarkerBatch& batch = exchange.receive(step);
        side.spread(batch.before_m, batch.impulse);
        expect_all_force(world, fluid, markers.impulses(step));
        received.add(side.received());
        fluid.advance();
        exchange.send(step, side.sample(batch.now_m));
    }
    const auto sums = received.collect(world.local());
    if (world.root()) send_numbers(world, coupled_steps, sums, timeout_s);
}

void run_all_splits(Owner owner) {
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        if (world.self() == Role::structure) {
            run_structure(world, owner);
        } else {
            run_fluid(world);
        }
    }
}

TEST(MarkerExchange, markers_on_every_structure_rank) {
    run_all_splits([](std::size_t m, int ranks) { return static_cast<int>(m) % ranks; });
}

TEST(MarkerExchange, a_structure_rank_without_markers_takes_part) {
    run_all_splits([](std::size_t, int ranks) { return ranks - 1; });
}

}  // namespace
}  // namespace magfsi::coupler
