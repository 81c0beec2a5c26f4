// Blocks cover every row once, neighbours agree, and impossible cuts are refused.
#include <gtest/gtest.h>

#include <set>

#include "fluid_lbm/parallel/decomposition.h"

namespace magfsi::fluid {
namespace {

void expect_cover(const Decomposition& d) {
    std::set<std::pair<int, int>> rows;
    for (const CellBox& box : d.boxes) {
        EXPECT_EQ(box.lo[0], 0);
        EXPECT_EQ(box.hi[0], d.cells[0]);
        for (int z = box.lo[2]; z < box.hi[2]; ++z) {
            for (int y = box.lo[1]; y < box.hi[1]; ++y) {
                EXPECT_TRUE(rows.insert({y, z}).second) << "row " << y << ' ' << z;
            }
        }
    }
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(d.cells[1]) * d.cells[2]);
}

TEST(Decomposition, CoversEveryRowOnce) {
    for (int ranks = 1; ranks <= 12; ++ranks) {
        for (bool periodic : {false, true}) {
            const auto d = decompose({7, 13, 11}, {true, periodic, periodic}, ranks);
            ASSERT_EQ(d.boxes.size(), static_cast<std::size_t>(ranks));
            expect_cover(d);
        }
    }
}

TEST(Decomposition, NeighborsAreMutual) {
    const auto d = decompose({4, 8, 8}, {true, true, false}, 8);
    for (int rank = 0; rank < 8; ++rank) {
        for (int axis = 1; axis <= 2; ++axis) {
            for (int side = 0; side < 2; ++side) {
                const int other = d.neighbor(rank, axis, side);
                if (other == no_rank) continue;
                EXPECT_EQ(d.neighbor(other, axis, 1 - side), rank);
            }
        }
    }
}

TEST(Decomposition, CutsTheLongAxis) {
    EXPECT_EQ(decompose({16, 8, 64}, {false, false, false}, 4).ranks,
              (std::array<int, 2>{1, 4}));
    EXPECT_EQ(decompose({16, 64, 8}, {false, false, false}, 4).ranks,
              (std::array<int, 2>{4, 1}));
    EXPECT_EQ(decompose({16, 64, 64}, {false, false, false}, 4).ranks,
              (std::array<int, 2>{2, 2}));
}

TEST(Decomposition, GivesSmallBoxesToManyRanks) {
    const auto d = decompose({16, 2, 3}, {true, true, true}, 6);
    EXPECT_EQ(d.ranks, (std::array<int, 2>{2, 3}));
    expect_cover(d);
}

TEST(Decomposition, RefusesMoreRanksThanRows) {
    EXPECT_THROW(decompose({16, 2, 3}, {true, true, true}, 5), std::invalid_argument);
    EXPECT_THROW(decompose({16, 2, 3}, {true, true, true}, 7), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::fluid
