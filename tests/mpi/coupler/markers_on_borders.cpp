// Interpolation and spreading conserve momentum and power where it is hardest: a cloud of
// markers through the whole box, larger than any rank's share, with markers exactly on
// rank borders, on walls, in edges and corners of the box, and beyond periodic sides.
#include <gtest/gtest.h>

#include <algorithm>

#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/spreading.h"
#include "coupler/participants/world.h"
#include "tests/mpi/coupler/array_fluid.h"
#include "tests/mpi/coupler/split.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

constexpr std::array<int, 3> cells{12, 10, 9};
constexpr std::int64_t steps = 2;

// Velocities are of order one; the shares of a marker, and of a cell some hundred
// markers' forces, are added in another order.
constexpr double rounding = 1e-13;
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
    for (const CellBox& box : grid.owned_by_rank) {
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

std::vector<Vec3> share(const std::vector<Vec3>& all, const World& world) {
    std::vector<Vec3> mine;
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (static_cast<int>(m) % world.size() == world.rank()) mine.push_back(all[m]);
    }
    return mine;
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
    const auto points = share(all.points_m, world);
    const auto impulse = share(all.impulse, world);
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
    const auto expected = share(on_one_rank(grid, kernel, all), world);
    for (std::size_t m = 0; m < points.size(); ++m)
        for (std::size_t d = 0; d < 3; ++d)
            worst.velocity =
                std::max(worst.velocity, std::abs(velocity[m][d] - expected[m][d]));
    const auto sums = given.collect(world.local());
    if (!world.root()) return;
    std::vector<double> received(sums.size());
    receive_numbers(world, steps, received, timeout_s);
    const Mismatch mismatch = worst_mismatch(sums, received);
    worst.momentum = std::max(worst.momentum, mismatch.momentum);
    worst.power = std::max(worst.power, mismatch.power);
}

void fluid_steps(const World& world, const Grid& grid, Kernel kernel) {
    ArrayFluid fluid(grid, world.rank());
    FluidSide side(fluid, grid.owned_by_rank[static_cast<std::size_t>(world.rank())],
                   kernel, ArrayFluid::step_s);
    FluidExchange exchange(world, timeout_s);
    BalanceRecord received;
    exchange.send(-1, side.sample(exchange.receive(-1).now_m));
    for (std::int64_t step = 0; step < steps; ++step) {
        const MarkerBatch& batch = exchange.receive(step);
        side.spread(batch.before_m, batch.impulse);
        received.add(side.received());
        fluid.advance();
        exchange.send(step, side.sample(batch.now_m));
    }
    const auto sums = received.collect(world.local());
    if (world.root()) send_numbers(world, steps, sums, timeout_s);
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
                        fluid_steps(world, grid, kernel);
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
