// The forces on obstacles are, step by step, exactly the momentum that the fluid loses,
// in a closed periodic box and with a body force, for every shape and both kinds of wall;
// also when an obstacle stands on a plane of symmetry or reaches through a periodic side.
#include <gtest/gtest.h>

#include "tests/unit/fluid_boundary/channel.h"

namespace magfsi::fluid {
namespace {

struct Case {
    const char* name;
    ObstacleShape shape;
    ObstacleWall wall;
    bool symmetry;  // free slip at both ends of z
};

class Force : public testing::TestWithParam<Case> {};

TEST_P(Force, IsTheMomentumThatTheFluidLoses) {
    const Case& c = GetParam();
    FluidConfig config = lattice_fluid({14, 12, 10}, 0.6, Collision::automatic);
    if (c.symmetry) {
        config.boundaries[4].kind = config.boundaries[5].kind = BoundaryKind::free_slip;
    }
    config.obstacles = {{"body", c.shape}, {"ball", Sphere{{11, 3, 3}, 3.3}}};
    config.obstacle_wall = c.wall;
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.05 + 0.01 * std::sin(x[1]), 0.02 * std::cos(x[0]), 0.01};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const int conserved = c.symmetry ? 2 : 3;  // axes; free slip takes momentum along z
    double largest = 0;
    for (int step = 0; step < 40; ++step) {
        const Vec3 before = fluid.totals().momentum_kg_m_s;
        fluid.step();
        const Vec3 after = fluid.totals().momentum_kg_m_s;
        const std::vector<Vec3> force = fluid.obstacle_forces();
        ASSERT_EQ(force.size(), 2u);
        for (int a = 0; a < conserved; ++a) {
            const double sum = force[0][a] + force[1][a];
            largest = std::max(largest, std::abs(sum));
            // Rounding of sums over 1680 cells of about 0.05 each.
            EXPECT_NEAR(sum, before[a] - after[a], 1e-12) << "step " << step;
        }
    }
    EXPECT_GT(largest, 0.01);  // there is something to compare
}

constexpr auto stairs = ObstacleWall::half_way, smooth = ObstacleWall::interpolated;

INSTANTIATE_TEST_SUITE_P(
    Shapes, Force,
    testing::Values(
        Case{"SphereStairs", Sphere{{5.3, 6.1, 5.2}, 5.1}, stairs, false},
        Case{"Sphere", Sphere{{5.3, 6.1, 5.2}, 5.1}, smooth, false},
        Case{"CylinderX", Cylinder{{5, 7.1, 7.2}, 3.3, 0, 4.0}, smooth, false},
        Case{"CylinderY", Cylinder{{5.1, 0, 5.2}, 4.3, 1, {}}, smooth, false},
        Case{"CylinderZ", Cylinder{{5.1, 5.4, 0}, 4.3, 2, {}}, smooth, false},
        Case{"Block", Block{{3.2, 4.1, 4.6}, {6.3, 7.7, 7.9}}, smooth, false},
        Case{"AcrossPeriodicSide", Block{{-1, -1, 6}, {3.3, 3.2, 9}}, smooth, false},
        Case{"HalfSphereOnSymmetry", Sphere{{5.3, 6.1, 0}, 5.1}, smooth, true},
        Case{"CylinderBetweenSymmetries", Cylinder{{5, 6, 5}, 4.4, 2, {}}, smooth, true}),
    [](const auto& shape) { return std::string(shape.param.name); });

}  // namespace
}  // namespace magfsi::fluid
