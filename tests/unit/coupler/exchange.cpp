// SPDX-License-Identifier: GPL-2.0-or-later
// What the two sides must agree on: partners, the margin between their renewals, the
// header of a message, the description of the grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupler/exchange/exchange.h"
#include "coupler/participants/errors.h"
#include "tests/support/checks.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Every cell that a marker can reach before the next renewal belongs to a partner.
bool holds(const CellBox& box, const std::array<int, 3>& cell) {
    for (std::size_t d = 0; d < 3; ++d)
        if (cell[d] < box.lo[d] || cell[d] >= box.hi[d]) return false;
    return true;
}

std::size_t owner(const Grid& grid, const std::array<int, 3>& cell) {
    std::size_t rank = 0;
    while (!holds(grid.owned_by_rank[rank].front(), cell)) ++rank;
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
    const double margin_m = Renewal{}.margin_cells * grid.spacing_m;
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

// No rank's margin reaches that far: without a word the body would be alone in a vacuum.
TEST(PartnerTable, far_outside_is_noticed_when_partners_are_chosen) {
    const std::vector<Vec3> points{{1e-3, 1e-3, 1e-3}, {1e-3, 1e-3, 9e-3}};
    EXPECT_THROW(partner_table(cut_grid({10, 10, 20}, {false, true, false}, {1, 2, 2}),
                               Kernel::three_point, points),
                 Diverged);
}

// A marker that outruns the partner table ends the run before a cell is missed in
// silence.
const Grid cube = cut_grid({20, 20, 20}, {true, true, true});
const double cube_h = cube.spacing_m;
const std::vector<Vec3> then{{cube_h, cube_h, cube_h},
                             {5 * cube_h, 5 * cube_h, 5 * cube_h}};

std::vector<Vec3> second_moved_by(std::size_t axis, double cells) {
    std::vector<Vec3> now = then;
    now[1][axis] += cells * cube_h;
    return now;
}

TEST(CheckMargin, up_to_the_margin_is_allowed) {
    for (const std::size_t axis : {0u, 1u, 2u}) {
        EXPECT_NO_THROW(check_margin(cube, then, second_moved_by(axis, 1.999), 5));
        EXPECT_NO_THROW(check_margin(cube, then, second_moved_by(axis, -1.999), 5));
    }
}

TEST(CheckMargin, beyond_it_names_step_marker_and_distance) {
    for (const std::size_t axis : {0u, 1u, 2u}) {
        EXPECT_THROW(check_margin(cube, then, second_moved_by(axis, -2.001), 5),
                     Diverged);
        test::expect_refusal<Diverged>(
            [&] { check_margin(cube, then, second_moved_by(axis, 2.5), 1234); },
            {"step 1234", "marker 1", "2.5 cells"});
    }
}

TEST(CheckMargin, a_nan_has_left_as_well) {
    auto now = then;
    now[0][2] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(check_margin(cube, then, now, 0), Diverged);
}

// A message of another step, or of other markers, is refused.
TEST(MessageHeader, the_same_step_and_markers_pass) {
    std::vector<double> message(message_header);
    for (const std::int64_t step : {-1LL, 0LL, 8LL, 4'000'000'000LL}) {
        write_header(message, step, 3);
        EXPECT_NO_THROW(check_header(message, step, 3, "fluid rank 0"));
    }
}

TEST(MessageHeader, another_step_is_refused_with_both_numbers) {
    std::vector<double> message(message_header);
    write_header(message, 41, 2);
    EXPECT_THROW(check_header(message, 40, 2, "structure rank 1"), PartnerLost);
    EXPECT_THROW(check_header(message, 41, 3, "structure rank 1"), PartnerLost);
    EXPECT_THROW(check_header(message, {40, 1}, 3, "structure rank 1"), PartnerLost);
    test::expect_refusal<PartnerLost>(
        [&] { check_header(message, 42, 2, "structure rank 1"); },
        {"structure rank 1", "step 41 with 2 markers", "expected step 42"});
}

// The grid that the structure hears of is the fluid's to the last bit.
TEST(GridText, reads_back_unchanged) {
    for (const double spacing_m : {2e-4, 1.0 / 7500, 0.1 / 3}) {
        Grid grid = cut_grid({40, 20, 33}, {true, false, true}, {1, 3, 2});
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
            EXPECT_EQ(back.owned_by_rank[rank], grid.owned_by_rank[rank]);
        }
    }
}

}  // namespace
}  // namespace magfsi::coupler
