// Free slip keeps mass and tangential momentum: a uniform flow along the sides stays as
// it is, and a moving box with any flow in it loses no mass. A plane of symmetry halves a
// flow: the upper half of a channel is the same with free slip in place of its other
// half.
#include <gtest/gtest.h>

#include "tests/unit/fluid_boundary/channel.h"

namespace magfsi::fluid {
namespace {

FluidConfig slip_box(int normal) {
    FluidConfig config = lattice_fluid({7, 6, 8}, 0.55, Collision::automatic);
    for (int side : {2 * normal, 2 * normal + 1}) {
        config.boundaries[side].kind = BoundaryKind::free_slip;
    }
    return config;
}

class FreeSlipSide : public testing::TestWithParam<int> {};

TEST_P(FreeSlipSide, LeavesUniformFlowAlone) {
    FluidConfig config = slip_box(GetParam());
    const int along = (GetParam() + 1) % 3;
    config.initial_velocity = [along](const Vec3&) {
        Vec3 u{};
        u[along] = 0.05;
        return u;
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    advance(fluid, 101);
    for_each_velocity(fluid, [&](const std::array<int, 3>&, const Vec3& u) {
        EXPECT_NEAR(u[along], 0.05, 1e-13);  // rounding of 101 steps
        EXPECT_NEAR(u[GetParam()], 0, 1e-13);
    });
}

TEST_P(FreeSlipSide, KeepsMassAndMomentumAlongTheSides) {
    FluidConfig config = slip_box(GetParam());
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.02 * std::sin(x[1] + x[2]), 0.03 * std::cos(x[0]), 0.01 * x[1] / 6};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const Totals before = fluid.totals();
    advance(fluid, 200);
    const Totals after = fluid.totals();
    // Rounding: 200 steps, 336 cells, sums in the order of the cells.
    EXPECT_NEAR(after.mass_kg, before.mass_kg, 1e-11);
    for (int a = 0; a < 3; ++a) {
        if (a == GetParam()) continue;
        EXPECT_NEAR(after.momentum_kg_m_s[a], before.momentum_kg_m_s[a], 1e-11);
    }
}

// Walls at the high ends; at the low ends either free slip or the mirror image.
FluidConfig corner_flow(bool half) {
    const int n = 5, factor = half ? 1 : 2;
    FluidConfig config =
        lattice_fluid({factor * n, factor * n, factor * n}, 0.7, Collision::automatic);
    for (int side = 0; side < 6; ++side) {
        config.boundaries[side].kind =
            half && side % 2 == 0 ? BoundaryKind::free_slip : BoundaryKind::no_slip;
    }
    const double middle = half ? 0 : n;
    config.initial_velocity = [middle](const Vec3& x) {
        const double r[3] = {x[0] - middle, x[1] - middle, x[2] - middle};
        // Odd in its own coordinate, even in the others: symmetric about all planes.
        return Vec3{0.01 * std::sin(r[0]) * std::cos(0.5 * r[1]),
                    0.02 * std::sin(0.7 * r[1]) * std::cos(r[2]),
                    -0.01 * std::sin(r[2]) * std::cos(0.3 * r[0])};
    };
    return config;
}

TEST(PlaneOfSymmetry, HoldsUpToItsEdgesAndCorners) {
    const FluidConfig whole_box = corner_flow(false), eighth = corner_flow(true);
    Fluid whole(MPI_COMM_SELF, whole_box), part(MPI_COMM_SELF, eighth);
    advance(whole, 51);
    advance(part, 51);
    const std::vector<double> all = velocity(whole);
    double largest = 0;
    for_each_velocity(part, [&](const std::array<int, 3>& cell, const Vec3& u) {
        const std::size_t at = ((cell[2] + 5) * 10 + cell[1] + 5) * 10 + cell[0] + 5;
        for (int a = 0; a < 3; ++a) {
            largest = std::max(largest, std::abs(u[a]));
            // Rounding of 51 steps: the mirror images add up in another order.
            EXPECT_NEAR(u[a], all[3 * at + a], 1e-14);
        }
    });
    EXPECT_GT(largest, 1e-4);  // the flow has not died before the comparison
}

INSTANTIATE_TEST_SUITE_P(Normal, FreeSlipSide, testing::Values(0, 1, 2));

}  // namespace
}  // namespace magfsi::fluid
