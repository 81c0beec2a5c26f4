// SPDX-License-Identifier: GPL-2.0-or-later
// Near walls the stencil keeps the partition of unity with the cells that are left;
// across a periodic side nothing is cut; outside a walled box there is no fluid, and the
// run ends and says where.
#include <gtest/gtest.h>

#include <limits>

#include "coupler/participants/errors.h"
#include "tests/support/checks.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

double sum(const Stencil1D& s) {
    double total = 0;
    for (const double w : s.weight) total += w;
    return total;
}

// Distances in cells from a wall, breakpoints of all kernels included.
constexpr double from_wall[] = {0, 1e-15, 0.1, 0.25, 0.5, 0.75, 1, 1.3, 1.5, 1.9, 2};

void check_point(const Grid& grid, Kernel kernel, const Vec3& in_cells) {
    const Vec3 point = in_cells * grid.spacing_m;
    const MarkerStencil stencil = marker_stencil(grid, kernel, point);
    for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_GE(stencil[d].first, 0);
        EXPECT_LE(stencil[d].first + stencil[d].count, grid.cells[d]);
        // At most four weights, each rounded twice.
        EXPECT_NEAR(sum(stencil[d]), 1, 2e-15) << "axis " << d << " at " << in_cells[d]
                                               << ", " << support(kernel) << " points";
    }
}

TEST(MarkerStencil, unity_near_every_wall_and_in_every_corner) {
    // Four cells: the widest kernel meets both walls at once.
    for (const int cells : {4, 9}) {
        const Grid grid = cut_grid({cells, cells, cells}, {false, false, false});
        for (const Kernel kernel : all_kernels) {
            for (const double a : from_wall) {
                check_point(grid, kernel, {a, 0.5 * cells, 0.5 * cells});
                check_point(grid, kernel, {0.5 * cells, cells - a, 0.5 * cells});
                for (const double b : from_wall) {
                    for (const double c : from_wall) {
                        check_point(grid, kernel, {a, b, c});
                        check_point(grid, kernel, {cells - a, b, cells - c});
                    }
                }
            }
        }
    }
}

// Half a cell from the wall the three-point kernel loses the 1/6 beyond it.
TEST(MarkerStencil, weights_half_a_cell_from_a_wall) {
    const Grid grid = cut_grid({8, 8, 8}, {false, false, false});
    const double h = grid.spacing_m;
    const MarkerStencil s =
        marker_stencil(grid, Kernel::three_point, {0.5 * h, 4 * h, 7.5 * h});
    ASSERT_EQ(s[0].first, 0);
    ASSERT_EQ(s[0].count, 2);
    // Rounding of 0.5 * h / h through the slope of the kernel.
    EXPECT_NEAR(s[0].weight[0], 0.8, 1e-15);
    EXPECT_NEAR(s[0].weight[1], 0.2, 1e-15);
    ASSERT_EQ(s[2].first, 6);
    ASSERT_EQ(s[2].count, 2);
    EXPECT_NEAR(s[2].weight[0], 0.2, 1e-15);
    EXPECT_NEAR(s[2].weight[1], 0.8, 1e-15);
}

// Weight of each cell of an axis, wrapped.
std::vector<double> cell_weights(const Stencil1D& s, int cells) {
    std::vector<double> weights(static_cast<std::size_t>(cells));
    for (int k = 0; k < s.count; ++k) {
        const int cell = wrapped(s.first + k, cells);
        EXPECT_GE(cell, 0);
        EXPECT_LT(cell, cells);
        weights.at(static_cast<std::size_t>(cell)) +=
            s.weight[static_cast<std::size_t>(k)];
    }
    return weights;
}

TEST(MarkerStencil, images_touch_the_same_cells) {
    const Grid grid = cut_grid({4, 7, 12}, {true, true, true});
    Random random(11);
    for (const Kernel kernel : all_kernels) {
        for (int trial = 0; trial < 500; ++trial) {
            Vec3 point;
            Vec3 image;
            for (std::size_t d = 0; d < 3; ++d) {
                const double size = grid.cells[d] * grid.spacing_m;
                point[d] = random.between(0, size);
                image[d] = point[d] + size * (trial % 5 - 2);
            }
            const auto here = marker_stencil(grid, kernel, point);
            const auto there = marker_stencil(grid, kernel, image);
            for (std::size_t d = 0; d < 3; ++d) {
                const auto a = cell_weights(here[d], grid.cells[d]);
                const auto b = cell_weights(there[d], grid.cells[d]);
                for (std::size_t i = 0; i < a.size(); ++i) {
                    // The image sits at up to 36 cells, so its place in cells is rounded
                    // to 7e-15, and the kernels' slopes are at most 1.
                    ASSERT_NEAR(a[i], b[i], 3e-14) << "axis " << d << ", cell " << i;
                }
            }
        }
    }
}

TEST(MarkerStencil, exactly_on_a_periodic_side) {
    const Grid grid = cut_grid({6, 6, 6}, {true, true, true});
    const double size = 6 * grid.spacing_m;
    for (const Kernel kernel : all_kernels) {
        const Vec3 point{0, size, -1e-30};  // the last wraps to exactly 6 cells
        const auto stencil = marker_stencil(grid, kernel, point);
        for (std::size_t d = 0; d < 3; ++d) {
            const auto weights = cell_weights(stencil[d], 6);
            // The side lies half-way between its neighbour cells.
            EXPECT_NEAR(weights[0], weights[5], 1e-15);
            EXPECT_GT(weights[0], 0.4);
        }
    }
}

// 2 x 2 x 4 mm, periodic along y.
const Grid walled = cut_grid({10, 10, 20}, {false, true, false}, {1, 2, 2});

std::string message_at(const Vec3& point_m) {
    return test::message_of<Diverged>(
        [&] { marker_stencil(walled, Kernel::three_point, point_m); });
}

TEST(LeavingTheBox, the_message_holds_the_point_and_the_box) {
    const std::string message = message_at({1e-3, 1e-3, 4.25e-3});
    test::expect_says(message, {"(1, 1, 4.25) mm", "2 x 2 x 4 mm", "fluid.box"});
}

TEST(LeavingTheBox, by_any_wall_and_by_any_amount) {
    for (const double out : {1e-9, 1e-4, 1.0}) {
        for (const Vec3& point : {Vec3{-out, 1e-3, 1e-3}, Vec3{2e-3 + out, 1e-3, 1e-3},
                                  Vec3{1e-3, 1e-3, -out}, Vec3{1e-3, 1e-3, 4e-3 + out}}) {
            EXPECT_THROW(marker_stencil(walled, Kernel::two_point, point), Diverged)
                << out;
        }
    }
}

TEST(LeavingTheBox, a_periodic_side_is_no_way_out) {
    EXPECT_NO_THROW(marker_stencil(walled, Kernel::four_point, {1e-3, -7e-3, 1e-3}));
    EXPECT_NO_THROW(marker_stencil(walled, Kernel::four_point, {1e-3, 7e-3, 1e-3}));
}

TEST(LeavingTheBox, no_position_at_all) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, inf, -inf}) {
        EXPECT_THROW(marker_stencil(walled, Kernel::three_point, {bad, 0, 0}), Diverged);
        EXPECT_THROW(marker_stencil(walled, Kernel::three_point, {0, bad, 0}), Diverged);
    }
}

}  // namespace
}  // namespace magfsi::coupler
