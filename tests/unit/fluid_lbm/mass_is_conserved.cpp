// Mass stays, to rounding, in a box whose walls are at rest or move.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

class MassIsConserved : public testing::TestWithParam<Collision> {};

TEST_P(MassIsConserved, BetweenWalls) {
    FluidConfig config = lattice_fluid({13, 7, 6}, 0.51, GetParam());
    for (int axis = 0; axis < 3; ++axis) set_walls(config, axis);
    config.boundaries[3].wall_velocity_m_s = {0.05, 0, 0.02};
    config.boundaries[0].wall_velocity_m_s = {0, -0.03, 0.01};
    config.body_force_n_m3 = Vec3{1e-5, -2e-5, 1e-5};
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.02 * std::sin(x[1]), 0.02 * std::cos(x[2]), 0.01 * std::sin(x[0])};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const double before = fluid.totals().mass_kg;
    constexpr int steps = 301;  // ends in the swapped arrangement
    for (int i = 0; i < steps; ++i) fluid.step();
    const double change = fluid.totals().mass_kg / before - 1;
    std::printf("relative change of mass over %d steps: %.1e\n", steps, change);
    // A rounding error of about 1e-18 a population a step, of random sign, is 1e-16 a
    // cell after 300 steps.
    EXPECT_NEAR(change, 0, 1e-14);
    EXPECT_FALSE(fluid.divergence());
}

INSTANTIATE_TEST_SUITE_P(Collisions, MassIsConserved,
                         testing::Values(Collision::bgk,
                                         Collision::recursive_regularized));

}  // namespace
}  // namespace magfsi::fluid
