// SPDX-License-Identifier: GPL-2.0-or-later
// Interpolation (eq. 14) and spreading (eq. 15) at obstacles.
#include <gtest/gtest.h>

#include "coupler/immersed_boundary/spreading.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Near obstacles markers read from and give to fluid cells alone, and neither force nor
// velocity is lost; also in boxes thinner than the kernel.
// A plate of 2 x 3 cells through the depth, across the periodic side of z.
Grid with_plate(int depth) {
    Grid grid = cut_grid({12, 10, depth}, {false, false, true});
    for (int z = 0; z < depth; ++z) {
        for (int y = 4; y < 7; ++y) grid.solid.push_back({y, z, 5, 7});
    }
    return grid;
}

class MarkersAtObstacles : public ::testing::TestWithParam<Kernel> {
  protected:
    std::vector<Vec3> outside(const Grid& grid, Random& random) {
        std::vector<Vec3> kept;
        for (const Vec3& p : random.points(grid, 400)) {
            if (SolidCells(grid).fluid_share(marker_stencil(grid, GetParam(), p)) > 1e-6)
                kept.push_back(p);
        }
        return kept;
    }
};

TEST_P(MarkersAtObstacles, give_all_their_force_to_the_fluid) {
    for (const int depth : {1, 2, 8}) {
        const Grid grid = with_plate(depth);
        Random random(5);
        const auto points = outside(grid, random);
        ASSERT_GT(points.size(), 300u);
        TouchedRows rows(grid, grid.owned_by_rank[0], GetParam());
        rows.place(points);
        const auto force = random.vectors(points.size(), 1e-6);
        std::vector<double> density(3 * rows.cells());
        rows.spread(force, 1, density);
        CellField field(grid);
        field.add(rows.rows(), density);
        Vec3 left{};
        for (const Vec3& f : force) left += f;
        const SolidCells solid(grid);
        for (int z = 0; z < depth; ++z)
            for (int y = 0; y < 10; ++y)
                for (int x = 0; x < 12; ++x)
                    for (std::size_t d = 0; d < 3; ++d) {
                        const double f = field.values()[field.index(x, y, z) + d];
                        EXPECT_TRUE(f == 0 || !solid.at(x, y, z));
                        left[d] -= f * std::pow(grid.spacing_m, 3);
                    }
        // Rounding of 400 forces of 1e-6, spread over up to 64 cells each.
        for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(left[d], 0, 1e-17) << depth;
    }
}

TEST_P(MarkersAtObstacles, sample_a_uniform_velocity_exactly) {
    for (const int depth : {1, 3}) {
        const Grid grid = with_plate(depth);
        Random random(6);
        const auto points = outside(grid, random);
        TouchedRows rows(grid, grid.owned_by_rank[0], GetParam());
        rows.place(points);
        std::vector<double> velocity(3 * rows.cells(), 0.7);
        std::vector<Vec3> found(points.size());
        rows.interpolate(velocity, found);
        // Up to 64 weights, scaled so that they add up to one.
        for (const Vec3& u : found) ASSERT_NEAR(u[1], 0.7, 1e-14);
    }
}

INSTANTIATE_TEST_SUITE_P(AllKernels, MarkersAtObstacles,
                         ::testing::ValuesIn(all_kernels));

TEST(SolidCells, leave_the_share_of_the_fluid) {
    const Grid grid = with_plate(4);
    const SolidCells solid(grid);
    const double h = grid.spacing_m;
    const auto share = [&](double x, double y) {
        return solid.fluid_share(
            marker_stencil(grid, Kernel::two_point, {x * h, y * h, 0.1 * h}));
    };
    EXPECT_EQ(share(3.2, 5.5), 1);           // far: exactly
    EXPECT_NEAR(share(5, 5.5), 0.5, 1e-14);  // on the wall between the cells 4 and 5
    EXPECT_EQ(share(6, 5.5), 0);
    EXPECT_NEAR(share(7.25, 5.5), 0.75, 1e-14);
}

TEST(SolidCells, of_a_grid_without_obstacles_are_none) {
    const Grid grid = cut_grid({5, 5, 5}, {true, true, true});
    EXPECT_FALSE(SolidCells(grid).any());
}

}  // namespace
}  // namespace magfsi::coupler
