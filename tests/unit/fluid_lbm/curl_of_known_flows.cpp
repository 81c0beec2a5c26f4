// Vorticity and enstrophy of flows whose difference quotients are known: a sine, and
// parabolas, which central and one-sided differences at (moving) walls reproduce exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

constexpr double spacing_m = 1e-4;

FluidConfig water(std::array<int, 3> cells) {
    FluidConfig config;
    config.cells = cells;
    config.spacing_m = spacing_m;
    config.time_step_s = 1e-5;
    config.density_kg_m3 = 1000;
    config.viscosity_m2_s = 1e-6;
    return config;
}

TEST(Curl, OfASineIsThatOfCentralDifferences) {
    constexpr int n = 12;
    constexpr double k = 2 * std::numbers::pi / (n * spacing_m), amplitude = 0.1;
    FluidConfig config = water({5, n, 6});
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{amplitude * std::sin(k * x[1]), 0, 0};
    };
    const Fluid fluid(MPI_COMM_WORLD, config);
    const double slope = amplitude * std::sin(k * spacing_m) / spacing_m;
    // Mean of cos^2 / 2; rounding of a sum over 360 cells.
    EXPECT_NEAR(fluid.enstrophy_1_s2(), slope * slope / 4, 1e-13 * slope * slope);
}

// A flow in all directions, between walls along one axis: the mean over rows is that of
// the cells one by one.
TEST(Enstrophy, is_that_of_the_vorticity) {
    for (const int normal : {0, 1, 2}) {
        FluidConfig config = water({7, 8, 9});
        set_walls(config, normal);
        config.initial_velocity = [](const Vec3& x) {
            const auto s = [](double a) { return 0.05 * std::sin(a / spacing_m); };
            return Vec3{s(x[1] + 2 * x[2]), s(x[0] - x[2]), s(2 * x[0] + x[1])};
        };
        const Fluid fluid(MPI_COMM_WORLD, config);
        std::vector<float> curl(3 * 7 * all_rows(fluid).size());
        fluid.vorticity(curl);
        double mean = 0;
        for (const float w : curl) mean += 0.5 * w * w / (7 * 8 * 9);
        MPI_Allreduce(MPI_IN_PLACE, &mean, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        // Single precision of each.
        EXPECT_NEAR(fluid.enstrophy_1_s2(), mean, 1e-6 * mean);
    }
}

// u along one axis, a parabola of the position along the wall's normal.
class CurlAtWalls : public testing::TestWithParam<int> {};

TEST_P(CurlAtWalls, OfAParabolaIsExact) {
    const int normal = GetParam(), along = (normal + 1) % 3, third = (normal + 2) % 3;
    constexpr double a = 0.01, b = 30, c = -4e4;  // m/s, 1/s, 1/(m s)
    FluidConfig config = water({6, 6, 6});
    set_walls(config, normal);
    const auto u = [](double s) { return a + b * s + c * s * s; };
    config.boundaries[2 * normal].wall_velocity_m_s[along] = u(0);
    config.boundaries[2 * normal + 1].wall_velocity_m_s[along] = u(6 * spacing_m);
    config.initial_velocity = [&](const Vec3& x) {
        Vec3 velocity{};
        velocity[along] = u(x[normal]);
        return velocity;
    };
    const Fluid fluid(MPI_COMM_WORLD, config);
    const CellBox box = fluid.owned();
    std::vector<float> curl(3 * 6 * all_rows(fluid).size());
    fluid.vorticity(curl);
    const float* value = curl.data();
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            for (int x = 0; x < 6; ++x, value += 3) {
                const double s = (std::array<int, 3>{x, y, z}[normal] + 0.5) * spacing_m;
                // curl_k = d u_j / d x_i for (i, j, k) in cyclic order. Single precision
                // of values near 30.
                EXPECT_NEAR(value[third], b + 2 * c * s, 1e-5);
                EXPECT_NEAR(value[normal], 0, 1e-5);
                EXPECT_NEAR(value[along], 0, 1e-5);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Normals, CurlAtWalls, testing::Values(0, 1, 2));

}  // namespace
}  // namespace magfsi::fluid
