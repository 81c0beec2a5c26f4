// What the fluid is asked for: each row once, inside the rank's box, and no row too many.
#include "coupler/immersed_boundary/touched_rows.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

TEST(TouchedRows, are_unique_and_inside_the_box) {
    const Grid grid = cut_grid({12, 10, 8}, {true, true, false}, {2, 3, 2});
    for (const Kernel kernel : all_kernels) {
        for (const CellBox& box : grid.owned_by_rank) {
            TouchedRows rows(grid, box, kernel);
            Random random(9);
            for (int turn = 0; turn < 3; ++turn) {  // place() must forget the rows before
                rows.place(random.points(grid, 60));
                std::set<std::pair<int, int>> seen;
                std::size_t cells = 0;
                for (const GridRow& r : rows.rows()) {
                    EXPECT_TRUE(seen.insert({r.y, r.z}).second) << r.y << ", " << r.z;
                    EXPECT_LT(r.x_begin, r.x_end);
                    EXPECT_GE(r.x_begin, box.lo[0]);
                    EXPECT_LE(r.x_end, box.hi[0]);
                    EXPECT_TRUE(r.y >= box.lo[1] && r.y < box.hi[1]) << r.y;
                    EXPECT_TRUE(r.z >= box.lo[2] && r.z < box.hi[2]) << r.z;
                    cells += static_cast<std::size_t>(r.x_end - r.x_begin);
                }
                EXPECT_EQ(cells, rows.cells());
            }
        }
    }
}

TEST(TouchedRows, one_marker_touches_its_kernel_and_no_more) {
    const Grid grid = cut_grid({12, 12, 12}, {true, true, true});
    const double h = grid.spacing_m;
    TouchedRows rows(grid, grid.owned_by_rank[0], Kernel::three_point);
    rows.place(std::vector<Vec3>{{5.6 * h, 6.4 * h, 7.5 * h}});
    ASSERT_EQ(rows.rows().size(), 9u);
    for (const GridRow& r : rows.rows()) {
        EXPECT_TRUE(r.x_begin == 4 && r.x_end == 7) << r.x_begin << " to " << r.x_end;
        EXPECT_TRUE(r.y >= 5 && r.y <= 7 && r.z >= 6 && r.z <= 8) << r.y << ", " << r.z;
    }
    EXPECT_EQ(rows.cells(), 27u);
}

// A row is one range of x: a marker across the side makes it run through.
TEST(TouchedRows, a_marker_across_the_periodic_x_side_reaches_both_ends) {
    const Grid grid = cut_grid({12, 12, 12}, {true, false, false});
    const double h = grid.spacing_m;
    TouchedRows rows(grid, grid.owned_by_rank[0], Kernel::two_point);
    rows.place(std::vector<Vec3>{{-0.2 * h, 6 * h, 6 * h}});
    CellField density(grid);
    std::vector<double> values(3 * rows.cells());
    rows.spread(std::vector<Vec3>{{1, 0, 0}}, values);
    density.add(rows.rows(), values);
    // Centres at 11.5 and 12.5 cells, the marker at 11.8; a quarter to each of four rows.
    const double quarter = 0.25 / (h * h * h);
    EXPECT_NEAR(density.values()[density.index(11, 5, 5)], 0.7 * quarter,
                1e-14 * quarter);
    EXPECT_NEAR(density.values()[density.index(0, 5, 5)], 0.3 * quarter, 1e-14 * quarter);
    EXPECT_EQ(density.values()[density.index(6, 5, 5)], 0);
}

TEST(TouchedRows, no_marker_no_row) {
    const Grid grid = cut_grid({12, 12, 12}, {true, true, true}, {1, 2, 1});
    TouchedRows rows(grid, grid.owned_by_rank[1], Kernel::four_point);
    EXPECT_EQ(rows.cells(), 0u);
    rows.place({});
    EXPECT_TRUE(rows.rows().empty());
    const double middle = 3 * grid.spacing_m;  // in the other rank's half
    rows.place(std::vector<Vec3>{{middle, middle, middle}});
    EXPECT_TRUE(rows.rows().empty());
    std::vector<Vec3> share(1, Vec3{9, 9, 9});
    rows.interpolate({}, share);
    EXPECT_EQ(share[0], Vec3{});
}

}  // namespace
}  // namespace magfsi::coupler
