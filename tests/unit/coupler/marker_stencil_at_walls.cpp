// Near walls the stencil keeps the partition of unity with the cells that are left.
#include <gtest/gtest.h>

#include "coupler/immersed_boundary/marker_stencil.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using testing::all_kernels;
using testing::cut_grid;

double sum(const Stencil1D& s) {
    double total = 0;
    for (const double w : s.weight) total += w;
    return total;
}

// Distances in cells from a wall, breakpoints of all kernels included.
constexpr double from_wall[] = {0, 1e-15, 0.1, 0.25, 0.5, 0.75, 1, 1.3, 1.5, 1.9, 2};

void check_point(const Grid& grid, Kernel kernel, const std::array<double, 3>& in_cells) {
    Vec3 point;
    for (std::size_t d = 0; d < 3; ++d) point[d] = in_cells[d] * grid.spacing_m;
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

}  // namespace
}  // namespace magfsi::coupler
