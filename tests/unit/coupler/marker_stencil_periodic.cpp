// Across a periodic side nothing is cut: the stencil of a point and of its images is one.
#include <gtest/gtest.h>

#include "coupler/immersed_boundary/marker_stencil.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using testing::all_kernels;
using testing::cut_grid;
using testing::Random;

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

}  // namespace
}  // namespace magfsi::coupler
