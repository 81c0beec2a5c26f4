// However the grid is cut into ranks' boxes, the shares add up to the answer of one box.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupler/immersed_boundary/touched_rows.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

constexpr std::array<int, 3> cells{10, 12, 9};
constexpr std::array<bool, 3> periodic{true, true, false};
constexpr std::size_t markers = 150;

// The velocities are of order one; 64 products are added in another order.
constexpr double rounding = 1e-14;

struct Sums {
    std::vector<Vec3> velocity;
    CellField density;
};

// The sum of all ranks' shares.
Sums sums(const Grid& grid, Kernel kernel) {
    Random random(5);
    const auto points = random.points(grid, markers);
    const auto force = random.vectors(markers, 1);
    CellField field(grid);
    for (double& u : field.values()) u = random.between(-1, 1);

    Sums total{std::vector<Vec3>(markers), CellField(grid)};
    for (const CellBox& box : grid.owned_by_rank) {
        TouchedRows rows(grid, box, kernel);
        rows.place(points);
        std::vector<Vec3> share(markers);
        rows.interpolate(field.read(rows.rows()), share);
        for (std::size_t m = 0; m < markers; ++m)
            for (std::size_t d = 0; d < 3; ++d) total.velocity[m][d] += share[m][d];
        std::vector<double> density(3 * rows.cells());
        rows.spread(force, density);
        total.density.add(rows.rows(), density);
    }
    return total;
}

class SharesAddUp : public ::testing::TestWithParam<std::array<int, 3>> {};

TEST_P(SharesAddUp, to_the_answer_of_one_box) {
    const double per_volume = std::pow(cut_grid(cells, periodic).spacing_m, -3);
    for (const Kernel kernel : all_kernels) {
        const Sums whole = sums(cut_grid(cells, periodic), kernel);
        const Sums parts = sums(cut_grid(cells, periodic, GetParam()), kernel);
        for (std::size_t m = 0; m < markers; ++m) {
            for (std::size_t d = 0; d < 3; ++d) {
                ASSERT_NEAR(parts.velocity[m][d], whole.velocity[m][d], rounding)
                    << "marker " << m;
            }
        }
        const auto& a = parts.density.values();
        const auto& b = whole.density.values();
        for (std::size_t i = 0; i < b.size(); ++i) {
            ASSERT_NEAR(a[i], b[i], rounding * per_volume) << "cell " << i / 3;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Cuts, SharesAddUp,
                         ::testing::Values(std::array{1, 2, 1}, std::array{1, 3, 2},
                                           std::array{2, 1, 1}, std::array{2, 3, 2},
                                           std::array{5, 6, 3}));

}  // namespace
}  // namespace magfsi::coupler
