// Mass stays, to rounding, in a box whose walls are at rest or move.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

using Case = std::tuple<Collision, Precision>;

class MassIsConserved : public testing::TestWithParam<Case> {};

TEST_P(MassIsConserved, BetweenWalls) {
    const auto [collision, precision] = GetParam();
    FluidConfig config = lattice_fluid({13, 7, 6}, 0.51, collision);
    config.precision = precision;
    for (int axis = 0; axis < 3; ++axis) set_walls(config, axis);
    config.boundaries[3].wall_velocity_m_s = {0.05, 0, 0.02};
    config.boundaries[0].wall_velocity_m_s = {0, -0.03, 0.01};
    config.body_force_n_m3 = Vec3{1e-5, -2e-5, 1e-5};
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.02 * std::sin(x[1]), 0.02 * std::cos(x[2]), 0.01 * std::sin(x[0])};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const double before = fluid.totals().mass_kg;
    constexpr int steps = 1001;  // ends in the swapped arrangement
    for (int i = 0; i < steps; ++i) fluid.step();
    const double change = fluid.totals().mass_kg / before - 1;
    std::printf("%s, %s: relative change of mass over %d steps %.1e\n",
                name_of(collision).data(), name_of(precision).data(), steps, change);
    // Populations of about 1e-3 are rounded by 1e-19 or 6e-11 a step; 19000 roundings of
    // random sign make 1e-17 or 8e-9 of a cell's mass, and cells may agree.
    EXPECT_NEAR(change, 0, precision == Precision::double_ ? 1e-15 : 5e-8);
    EXPECT_FALSE(fluid.divergence());
    EXPECT_FALSE(fluid.diverged());
}

INSTANTIATE_TEST_SUITE_P(
    All, MassIsConserved,
    testing::Combine(
        testing::Values(Collision::bgk, Collision::trt, Collision::recursive_regularized),
        testing::Values(Precision::double_, Precision::float_, Precision::float_double)));

}  // namespace
}  // namespace magfsi::fluid
