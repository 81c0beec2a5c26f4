// Every cell that a marker can reach before the next renewal belongs to a partner.
#include "coupler/exchange/partner_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupler/immersed_boundary/marker_stencil.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

bool holds(const CellBox& box, const std::array<int, 3>& cell) {
    for (std::size_t d = 0; d < 3; ++d)
        if (cell[d] < box.lo[d] || cell[d] >= box.hi[d]) return false;
    return true;
}

std::size_t owner(const Grid& grid, const std::array<int, 3>& cell) {
    std::size_t rank = 0;
    while (!holds(grid.owned_by_rank[rank], cell)) ++rank;
    return rank;
}

// Ranks that own a cell of nonzero weight of the marker at point.
std::vector<bool> ranks_met(const Grid& grid, Kernel kernel, const Vec3& point) {
    std::vector<bool> met(grid.owned_by_rank.size());
    const MarkerStencil s = marker_stencil(grid, kernel, point);
    for (int k = 0; k < s[2].count; ++k)
        for (int j = 0; j < s[1].count; ++j)
            for (int i = 0; i < s[0].count; ++i) {
                const auto at = [](int index) { return static_cast<std::size_t>(index); };
                const double weight =
                    s[0].weight[at(i)] * s[1].weight[at(j)] * s[2].weight[at(k)];
                if (weight == 0) continue;
                met[owner(grid, {wrapped(s[0].first + i, grid.cells[0]),
                                 wrapped(s[1].first + j, grid.cells[1]),
                                 wrapped(s[2].first + k, grid.cells[2])})] = true;
            }
    return met;
}

// The point moved by up to the margin along each axis, no further than the walls.
Vec3 moved(const Grid& grid, const Vec3& point, Random& random, bool to_the_limit) {
    const double margin_m = renew_margin_cells * grid.spacing_m;
    Vec3 p = point;
    for (std::size_t d = 0; d < 3; ++d) {
        const double share = random.between(-1, 1);
        p[d] += margin_m * (to_the_limit ? std::copysign(1, share) : share);
        if (!grid.periodic[d])
            p[d] = std::clamp(p[d], 0.0, grid.cells[d] * grid.spacing_m);
    }
    return p;
}

struct Case {
    std::array<int, 3> cells;
    std::array<bool, 3> periodic;
    std::array<int, 3> pieces;
};

class PartnerTable : public ::testing::TestWithParam<Case> {};

TEST_P(PartnerTable, covers_every_cell_within_the_margin) {
    const auto& [cells, periodic, pieces] = GetParam();
    const Grid grid = cut_grid(cells, periodic, pieces);
    Random random(17);
    for (const Kernel kernel : all_kernels) {
        const auto points = random.points(grid, 200);
        const auto table = partner_table(grid, kernel, points);
        ASSERT_EQ(table.size(), grid.owned_by_rank.size());
        for (int m = 0; m < 200; ++m) {
            for (int trial = 0; trial < 20; ++trial) {
                const Vec3 p = moved(grid, points[static_cast<std::size_t>(m)], random,
                                     trial % 2 == 0);
                const auto met = ranks_met(grid, kernel, p);
                for (std::size_t rank = 0; rank < met.size(); ++rank) {
                    if (!met[rank]) continue;
                    ASSERT_TRUE(
                        std::binary_search(table[rank].begin(), table[rank].end(), m))
                        << "marker " << m << ", rank " << rank;
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Decompositions, PartnerTable,
    ::testing::Values(Case{{24, 24, 24}, {false, false, false}, {1, 1, 1}},
                      Case{{24, 24, 24}, {false, false, false}, {1, 2, 2}},
                      Case{{24, 24, 24}, {true, true, true}, {1, 3, 2}},
                      Case{{40, 37, 31}, {true, false, true}, {2, 3, 4}},
                      Case{{4, 5, 6}, {true, true, true}, {1, 5, 3}},
                      Case{{16, 16, 64}, {false, true, false}, {1, 1, 16}}));

// The table is there to leave messages out: a marker far from a box is not sent to it.
TEST(PartnerTable, leaves_out_ranks_beyond_reach) {
    const Grid grid = cut_grid({40, 40, 40}, {false, true, false}, {1, 4, 1});
    const double h = grid.spacing_m;
    const std::vector<Vec3> points{{20 * h, 15 * h, 20 * h}, {20 * h, 0.5 * h, 20 * h}};
    const auto table = partner_table(grid, Kernel::three_point, points);
    EXPECT_EQ(table[0], std::vector<int>{1});  // next to its lower side
    EXPECT_EQ(table[1], std::vector<int>{0});  // in its middle
    EXPECT_TRUE(table[2].empty());
    EXPECT_EQ(table[3], std::vector<int>{1});  // across the periodic side
}

}  // namespace
}  // namespace magfsi::coupler
