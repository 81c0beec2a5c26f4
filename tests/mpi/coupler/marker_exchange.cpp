// SPDX-License-Identifier: GPL-2.0-or-later
// The exchange between any number of structure and fluid ranks gives what one rank of
// each would compute: velocities, forces, momentum and power, in every coupled step.
#include <gtest/gtest.h>
#include <algorithm>
#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/fluid_side.h"
#include "coupler/participants/handshake.h"
#include "coupler/participants/world.h"
#include "tests/mpi/coupler/array_fluid.h"
#include "tests/mpi/coupler/split.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Velocities are of order one; shares and forces, of some hundred markers on a cell or in
// 40 steps, are added in another order.
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

// `spread` is called after each spreading, with the step and the fluid.
template <class Spread>
void fluid_steps(const World& world, const Grid& grid, Kernel kernel, std::int64_t steps,
                 const Spread& spread) {
    ArrayFluid fluid(grid, world.rank());
    FluidSide side(fluid, grid.owned_by_rank[static_cast<std::size_t>(world.rank())],
                   kernel, ArrayFluid::step_s);
    FluidExchange exchange(world, timeout_s);
    BalanceRecord received;
    exchange.send(-1, side.sample(exchange.receive(-1).now_m));
    for (std::int64_t step = 0; step < steps; ++step) {
        const MarkerBatch& batch = exchange.receive(step);
        side.spread(batch.before_m, batch.impulse);
        spread(step, fluid);
        received.add(side.received());
        fluid.advance();
        exchange.send(step, side.sample(batch.now_m));
    }
    const auto sums = received.collect(world.local());
    if (world.root()) send_numbers(world, steps, sums, timeout_s);
}

void run_fluid(const World& world) {
    const Grid grid = channel(world.size());
    const TravellingMarkers markers(grid.spacing_m);
    fluid_steps(world, grid, kernel, coupled_steps,
                [&](std::int64_t step, const ArrayFluid& fluid) {
                    expect_all_force(world, fluid, markers.impulses(step));
                });
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

int in_turn(std::size_t m, int ranks) {
    return static_cast<int>(m) % ranks;
}

TEST(MarkerExchange, markers_on_every_structure_rank) {
    run_all_splits(in_turn);
}

TEST(MarkerExchange, a_structure_rank_without_markers_takes_part) {
    run_all_splits([](std::size_t, int ranks) { return ranks - 1; });
}

// Interpolation and spreading conserve momentum and power where it is hardest: a cloud of
// markers through the whole box, larger than any rank's share, with markers exactly on
// rank borders, on walls, in edges and corners of the box, and beyond periodic sides.
constexpr std::array<int, 3> cells{12, 10, 9};
constexpr std::int64_t steps = 2;

// What the interface promises. Sums of 1e6 products of either sign, relative to the sum
// of the markers' magnitudes: some 1e-15.
constexpr double balance_bound = 1e-12;

std::vector<std::array<int, 3>> cuts(int ranks) {
    if (ranks == 1) return {{1, 1, 1}};
    if (ranks == 2) return {{2, 1, 1}, {1, 2, 1}, {1, 1, 2}};
    if (ranks == 3) return {{3, 1, 1}, {1, 3, 1}, {1, 1, 3}};
    return {{1, ranks, 1}};
}

constexpr std::array<bool, 3> sides[] = {
    {false, false, false}, {true, true, true}, {true, false, true}};

// Along one axis, in cells: ends of the box, borders of ranks, cell centres and faces on
// both sides of them, and what lies a rounding beside a border.
std::vector<double> places(const Grid& grid, std::size_t axis) {
    const double n = cells[axis];
    std::vector<double> at{0, 0.25, 0.5, n - 0.5, n};
    if (grid.periodic[axis]) at.insert(at.end(), {-0.4, n + 1.5});
    for (const std::vector<CellBox>& boxes : grid.owned_by_rank) {
        const CellBox& box = boxes.front();
        const double border = box.lo[axis];
        if (border == 0) continue;
        at.insert(at.end(),
                  {border, std::nextafter(border, 0), border - 0.5, border + 1});
    }
    std::ranges::sort(at);
    at.erase(std::ranges::unique(at).begin(), at.end());
    return at;
}

struct Cloud {
    std::vector<Vec3> points_m, impulse;
};

Cloud cloud(const Grid& grid) {
    Cloud c;
    for (const double x : places(grid, 0))
        for (const double y : places(grid, 1))
            for (const double z : places(grid, 2))
                c.points_m.push_back(
                    {x * grid.spacing_m, y * grid.spacing_m, z * grid.spacing_m});
    Random random(8);
    c.impulse = random.vectors(c.points_m.size(), 1e-9);
    return c;
}

// After both steps, from one box.
std::vector<Vec3> on_one_rank(const Grid& grid, Kernel kernel, const Cloud& c) {
    const Grid whole = cut_grid(cells, grid.periodic);
    ArrayFluid fluid(whole, 0);
    FluidSide side(fluid, whole.owned_by_rank[0], kernel, ArrayFluid::step_s);
    for (std::int64_t step = 0; step < steps; ++step) {
        side.spread(c.points_m, c.impulse);
        fluid.advance();
    }
    const auto u = side.sample(c.points_m);
    return {u.begin(), u.end()};
}

struct Worst {
    double velocity = 0, momentum = 0, power = 0;
};

void structure_steps(const World& world, const Grid& grid, Kernel kernel, Worst& worst) {
    const Cloud all = cloud(grid);
    const auto points = own(all.points_m, world, in_turn);
    const auto impulse = own(all.impulse, world, in_turn);
    StructureExchange exchange(world, grid, kernel, timeout_s);
    BalanceRecord given;
    std::vector<Vec3> velocity(points.size());
    send_first(exchange, points);
    exchange.receive(-1, velocity);
    EXPECT_EQ(exchange.partners(), world.partner_size()) << "the cloud fills the box";
    for (std::int64_t step = 0; step < steps; ++step) {
        InterfaceBalance balance;
        for (std::size_t m = 0; m < points.size(); ++m)
            add_marker(balance, impulse[m], velocity[m]);
        given.add(balance);
        exchange.send(step, points, impulse, points);
        exchange.receive(step, velocity);
    }
    const auto expected = own(on_one_rank(grid, kernel, all), world, in_turn);
    worst.velocity = std::max(worst.velocity, worst_difference(velocity, expected));
    const auto sums = given.collect(world.local());
    if (!world.root()) return;
    std::vector<double> received(sums.size());
    receive_numbers(world, steps, received, timeout_s);
    const Mismatch mismatch = worst_mismatch(sums, received);
    worst.momentum = std::max(worst.momentum, mismatch.momentum);
    worst.power = std::max(worst.power, mismatch.power);
}

TEST(MarkersOnBorders, conserve_momentum_and_power) {
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        const bool structure = world.self() == Role::structure;
        const int fluid_ranks = structure ? world.partner_size() : world.size();
        Worst worst;
        for (const auto& cut : cuts(fluid_ranks)) {
            for (const auto& periodic : sides) {
                for (const Kernel kernel : all_kernels) {
                    const Grid grid = cut_grid(cells, periodic, cut);
                    if (structure)
                        structure_steps(world, grid, kernel, worst);
                    else
                        fluid_steps(world, grid, kernel, steps, [](auto...) {});
                }
            }
        }
        EXPECT_LE(worst.velocity, rounding);
        EXPECT_LE(worst.momentum, balance_bound);
        EXPECT_LE(worst.power, balance_bound);
        if (structure && world.root()) {
            std::printf("%d + %d ranks: velocity %.1e m/s, momentum %.1e, power %.1e\n",
                        world.size(), world.partner_size(), worst.velocity,
                        worst.momentum, worst.power);
        }
    }
}

}  // namespace
}  // namespace magfsi::coupler
