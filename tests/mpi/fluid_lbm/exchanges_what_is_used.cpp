// A rank sends over a cut side the populations that its neighbour will use, and nothing
// over other sides; a box of one cell of depth has rows and ghosts of one cell alone.
#include <gtest/gtest.h>

#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/parallel/slots_type.h"

namespace magfsi::fluid {
namespace {

constexpr int nx = 16, ny = 12;

// Populations of one row that the low rank of two borrows over its cut along y.
double borrowed(const std::array<bool, 3>& periodic) {
    const Decomposition two = decompose({nx, ny, 1}, periodic, 2);
    const RowLayout rows = two.layout(0);
    const Populations populations(rows.nx, rows.row_count(), Storage::double_);
    const SlotsType slots(rows, populations, 1, 1, rows.ny);
    int bytes = 0;
    MPI_Type_size(slots.get(), &bytes);
    return bytes / (8.0 * nx);
}

TEST(Exchange, IsOfFiveInNineteenPopulations) {
    EXPECT_EQ(borrowed({true, true, true}), 5);
}

TEST(Exchange, LeavesOutWhatBouncesOffWalls) {
    // Of the five, the two that lean along z come from the walls.
    EXPECT_EQ(borrowed({true, false, false}), 3);
    // Beside walls across x two of them lean along x: one cell of each stays.
    EXPECT_EQ(borrowed({false, true, true}), 5 - 2.0 / nx);
}

TEST(Exchange, IsWithNobodyAcrossSidesThatAreNotCut) {
    const Decomposition two = decompose({nx, ny, 1}, {true, true, true}, 2);
    EXPECT_EQ(two.ranks, (std::array<int, 2>{2, 1}));
    for (int side = 0; side < 2; ++side) {
        EXPECT_NE(two.neighbor(0, 1, side), no_rank);
        EXPECT_EQ(two.neighbor(0, 2, side), no_rank);
    }
}

TEST(QuasiTwoDimensional, HasOneCellOfDepth) {
    const Decomposition one = decompose({nx, ny, 1}, {true, true, true}, 1);
    EXPECT_EQ(one.layout(0).row_count(), ny);
    const Decomposition two = decompose({nx, ny, 1}, {true, true, true}, 2);
    EXPECT_EQ(two.layout(0).row_count(), ny / 2 + 2);  // ghost rows at the two cuts
}

}  // namespace
}  // namespace magfsi::fluid
