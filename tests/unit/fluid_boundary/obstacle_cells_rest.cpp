// Cells in an obstacle stay at rest whatever pushes them: no velocity, no vorticity, no
// share in mass, energy or the search for divergence.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/fluid_boundary/channel.h"

namespace magfsi::fluid {
namespace {

bool in_block(const std::array<int, 3>& cell) {
    return cell[0] >= 4 && cell[0] < 9 && cell[1] >= 3 && cell[1] < 6 && cell[2] < 4;
}

FluidConfig pushed_around_a_block() {
    FluidConfig config = lattice_fluid({12, 9, 8}, 0.6, Collision::automatic);
    set_walls(config, 2);
    config.obstacles = {{"block", Block{{4, 3, -1}, {9, 6, 4}}}};
    config.body_force_n_m3 = Vec3{1e-4, 2e-5, 0};
    config.initial_velocity = [](const Vec3&) { return Vec3{0.05, 0.01, 0.02}; };
    return config;
}

TEST(ObstacleCells, AreAtRest) {
    const FluidConfig config = pushed_around_a_block();
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int step = 0; step < 30; ++step) {
        for_each_velocity(fluid, [&](const std::array<int, 3>& cell, const Vec3& u) {
            const double squared = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
            if (in_block(cell)) {
                EXPECT_EQ(squared, 0) << "step " << step;
            } else {
                EXPECT_GT(squared, 0) << "step " << step;
            }
        });
        EXPECT_FALSE(fluid.divergence());
        fluid.step();
    }
}

TEST(ObstacleCells, HaveNoMassAndNoVorticity) {
    FluidConfig config = pushed_around_a_block();
    config.initial_velocity = nullptr;
    Fluid fluid(MPI_COMM_WORLD, config);
    EXPECT_EQ(fluid.totals().mass_kg, 12 * 9 * 8 - 5 * 3 * 4);
    advance(fluid, 20);
    std::vector<float> curl(3 * 12 * all_rows(fluid).size());
    fluid.vorticity(curl);
    std::size_t i = 0;
    double largest = 0;
    for_each_velocity(fluid, [&](const std::array<int, 3>& cell, const Vec3&) {
        for (int a = 0; a < 3; ++a, ++i) {
            if (in_block(cell)) {
                EXPECT_EQ(curl[i], 0);
            }
            largest = std::max(largest, std::abs(static_cast<double>(curl[i])));
        }
    });
    EXPECT_GT(largest, 1e-4);  // u / h = 20 * 1e-4 / 4: the fluid moves
}

TEST(ObstacleCells, MustExist) {
    FluidConfig config = lattice_fluid({12, 9, 8}, 0.6, Collision::automatic);
    config.obstacles = {{"grain", Sphere{{5, 5, 5}, 0.5}}};
    try {
        Fluid fluid(MPI_COMM_WORLD, config);
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("\"grain\" holds the centre of no cell"),
                  std::string::npos)
            << error.what();
    }
}

// 4/3 pi r^3 of cells, through the periodic sides or not.
TEST(ObstacleCells, FillTheSphere) {
    FluidConfig config = lattice_fluid({24, 24, 24}, 0.6, Collision::automatic);
    config.obstacles = {{"ball", Sphere{{12.3, 11.8, 12.1}, 18}}};
    Fluid fluid(MPI_COMM_WORLD, config);
    const double solid = 24 * 24 * 24 - fluid.totals().mass_kg;
    // Cells on the surface, 4 pi r^2, count whole or not at all: sqrt(1018) / 2 at
    // random.
    EXPECT_NEAR(solid, std::numbers::pi / 6 * 18 * 18 * 18, 32);
}

}  // namespace
}  // namespace magfsi::fluid
