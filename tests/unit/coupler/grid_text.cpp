// The grid that the structure hears of is the fluid's to the last bit.
#include "coupler/immersed_boundary/grid_text.h"

#include <gtest/gtest.h>

#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

TEST(GridText, reads_back_unchanged) {
    for (const double spacing_m : {2e-4, 1.0 / 7500, 0.1 / 3}) {
        Grid grid = testing::cut_grid({40, 20, 33}, {true, false, true}, {1, 3, 2});
        grid.spacing_m = spacing_m;
        grid.solid = {{3, 5, 7, 11}, {4, 5, 0, 40}};
        const Grid back = grid_from_text(to_text(grid));
        EXPECT_EQ(back.spacing_m, grid.spacing_m);
        EXPECT_EQ(back.cells, grid.cells);
        EXPECT_EQ(back.periodic, grid.periodic);
        ASSERT_EQ(back.solid.size(), 2u);
        EXPECT_EQ(back.solid[0].y, 3);
        EXPECT_EQ(back.solid[0].z, 5);
        EXPECT_EQ(back.solid[0].x_begin, 7);
        EXPECT_EQ(back.solid[0].x_end, 11);
        ASSERT_EQ(back.owned_by_rank.size(), 6u);
        for (std::size_t rank = 0; rank < 6; ++rank) {
            EXPECT_EQ(back.owned_by_rank[rank].lo, grid.owned_by_rank[rank].lo);
            EXPECT_EQ(back.owned_by_rank[rank].hi, grid.owned_by_rank[rank].hi);
        }
    }
}

}  // namespace
}  // namespace magfsi::coupler
