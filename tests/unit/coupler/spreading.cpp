// SPDX-License-Identifier: GPL-2.0-or-later
// Interpolation (eq. 14) and spreading (eq. 15), on one rank and on several, and with the
// forces that are still to act.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "coupler/immersed_boundary/fluid_side.h"
#include "tests/mpi/coupler/array_fluid.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Interpolation (eq. 14) and spreading (eq. 15) are adjoint; spreading keeps the force
// and interpolation a uniform velocity.
constexpr std::size_t marker_count = 200;

// Sums of some 1e4 products round to about 1e-15 of the sum of their magnitudes.
constexpr double rounding = 1e-13;

class SpreadingAndInterpolation : public ::testing::TestWithParam<Kernel> {
  protected:
    SpreadingAndInterpolation()
        : grid_(cut_grid({13, 11, 9}, {true, false, true})),
          rows_(grid_, grid_.owned_by_rank[0], GetParam()),
          random_(3) {
        rows_.place(random_.points(grid_, marker_count));
    }

    double cell_volume_m3() const { return std::pow(grid_.spacing_m, 3); }

    Grid grid_;
    TouchedRows rows_;
    Random random_;
};

TEST_P(SpreadingAndInterpolation, are_adjoint) {
    const auto force = random_.vectors(marker_count, 1e-6);
    std::vector<double> velocity(3 * rows_.cells());
    for (double& u : velocity) u = random_.between(-0.5, 0.5);
    std::vector<Vec3> at_markers(marker_count);
    rows_.interpolate(velocity, at_markers);
    std::vector<double> density(velocity.size());
    rows_.spread(force, 1, density);

    double power_of_markers = 0;
    double scale = 0;
    for (std::size_t m = 0; m < marker_count; ++m) {
        for (std::size_t d = 0; d < 3; ++d) {
            power_of_markers += force[m][d] * at_markers[m][d];
            scale += std::abs(force[m][d] * at_markers[m][d]);
        }
    }
    double power_of_cells = 0;
    for (std::size_t i = 0; i < density.size(); ++i) {
        power_of_cells += density[i] * velocity[i] * cell_volume_m3();
    }
    std::printf("power: relative difference %.1e\n",
                std::abs(power_of_markers - power_of_cells) / scale);
    EXPECT_NEAR(power_of_markers, power_of_cells, rounding * scale);
}

TEST_P(SpreadingAndInterpolation, spreading_keeps_the_total_force) {
    const auto force = random_.vectors(marker_count, 1e-6);
    std::vector<double> density(3 * rows_.cells());
    rows_.spread(force, 1, density);
    Vec3 total{};
    Vec3 expected{};
    for (std::size_t i = 0; i < density.size(); ++i)
        total[i % 3] += density[i] * cell_volume_m3();
    for (const Vec3& f : force) expected += f;
    for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_NEAR(total[d], expected[d], rounding * marker_count * 1e-6)
            << "axis " << d;
    }
}

TEST_P(SpreadingAndInterpolation, a_uniform_velocity_is_sampled_exactly) {
    std::vector<double> velocity(3 * rows_.cells());
    const Vec3 uniform{0.3, -0.7, 1.1};
    for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = uniform[i % 3];
    std::vector<Vec3> at_markers(marker_count, Vec3{9, 9, 9});
    rows_.interpolate(velocity, at_markers);
    for (const Vec3& u : at_markers) {
        for (std::size_t d = 0; d < 3; ++d) {
            // Up to 64 weights that add up to one, each rounded.
            ASSERT_NEAR(u[d], uniform[d], 2e-14);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AllKernels, SpreadingAndInterpolation,
                         ::testing::ValuesIn(all_kernels));

// Forcing no_slip: with the row sums one pass is exact where the slip is uniform. A plane
// of markers one cell apart, anywhere between the cells, of unequal volumes.
TEST_P(SpreadingAndInterpolation, with_row_sums_the_fluid_passes_at_the_bodys_speed) {
    const Grid grid = cut_grid({8, 7, 12}, {true, true, true});
    ArrayFluid fluid(grid, 0);
    NoSlipFluidSide side(fluid, grid.owned_by_rank[0], GetParam(), ArrayFluid::step_s,
                         ArrayFluid::density_kg_m3, {});
    const NoSlipAnswer& answer = *side.answer();
    std::vector<Vec3> points;
    std::vector<double> volume;
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 8; ++x) {
            points.push_back({(x + 0.3) * grid.spacing_m, (y + 0.8) * grid.spacing_m,
                              5.27 * grid.spacing_m});
            volume.push_back(0.7 * cell_volume_m3());
        }
    }
    const auto sampled = side.sample(points, volume);
    const std::vector<Vec3> before(sampled.begin(), sampled.end());
    const Vec3 slip{0.2, -0.1, 0.3};
    std::vector<Vec3> impulse(points.size());
    for (std::size_t m = 0; m < points.size(); ++m) {
        impulse[m] = 2 * ArrayFluid::density_kg_m3 * volume[m] / answer.row_sum[m] * slip;
    }
    side.spread(points, impulse);
    for (std::size_t m = 0; m < points.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d)
            ASSERT_NEAR(answer.passed[m][d], before[m][d] + slip[d], rounding);
    }
}

// However the grid is cut into ranks' boxes, the shares add up to the answer of one box.
constexpr std::array<int, 3> cut_cells{10, 12, 9};
constexpr std::array<bool, 3> periodic{true, true, false};
constexpr std::size_t cloud_size = 150;

// The velocities are of order one; 64 products are added in another order.
constexpr double shares_rounding = 1e-14;

struct Sums {
    std::vector<Vec3> velocity;
    CellField density;
};

// The sum of all ranks' shares.
Sums sums(const Grid& grid, Kernel kernel) {
    Random random(5);
    const auto points = random.points(grid, cloud_size);
    const auto force = random.vectors(cloud_size, 1);
    CellField field(grid);
    for (double& u : field.values()) u = random.between(-1, 1);

    Sums total{std::vector<Vec3>(cloud_size), CellField(grid)};
    for (const std::vector<CellBox>& boxes : grid.owned_by_rank) {
        TouchedRows rows(grid, boxes, kernel);
        rows.place(points);
        std::vector<Vec3> share(cloud_size);
        rows.interpolate(field.read(rows.rows()), share);
        for (std::size_t m = 0; m < cloud_size; ++m) total.velocity[m] += share[m];
        std::vector<double> density(3 * rows.cells());
        rows.spread(force, 1, density);
        total.density.add(rows.rows(), density);
    }
    return total;
}

class SharesAddUp : public ::testing::TestWithParam<std::array<int, 3>> {};

TEST_P(SharesAddUp, to_the_answer_of_one_box) {
    const double per_volume = std::pow(cut_grid(cut_cells, periodic).spacing_m, -3);
    for (const Kernel kernel : all_kernels) {
        const Sums whole = sums(cut_grid(cut_cells, periodic), kernel);
        const Sums parts = sums(cut_grid(cut_cells, periodic, GetParam()), kernel);
        for (std::size_t m = 0; m < cloud_size; ++m) {
            for (std::size_t d = 0; d < 3; ++d) {
                ASSERT_NEAR(parts.velocity[m][d], whole.velocity[m][d], shares_rounding)
                    << "marker " << m;
            }
        }
        const auto& a = parts.density.values();
        const auto& b = whole.density.values();
        for (std::size_t i = 0; i < b.size(); ++i) {
            ASSERT_NEAR(a[i], b[i], shares_rounding * per_volume) << "cell " << i / 3;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Cuts, SharesAddUp,
                         ::testing::Values(std::array{1, 2, 1}, std::array{1, 3, 2},
                                           std::array{2, 1, 1}, std::array{2, 3, 2},
                                           std::array{5, 6, 3}));

// What the fluid is asked for: each row once, inside the rank's box, and no row too many.
TEST(TouchedRows, are_unique_and_inside_the_box) {
    const Grid grid = cut_grid({12, 10, 8}, {true, true, false}, {2, 3, 2});
    for (const Kernel kernel : all_kernels) {
        for (const std::vector<CellBox>& boxes : grid.owned_by_rank) {
            const CellBox& box = boxes.front();
            TouchedRows rows(grid, boxes, kernel);
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
    rows.spread(std::vector<Vec3>{{1, 0, 0}}, 1, values);
    density.add(rows.rows(), values);
    // Centres at 11.5 and 12.5 cells, the marker at 11.8; a quarter to each of four rows.
    const double quarter = 0.25 / (h * h * h);
    EXPECT_NEAR(density.values()[density.index(11, 5, 5)], 0.7 * quarter,
                1e-14 * quarter);
    EXPECT_NEAR(density.values()[density.index(0, 5, 5)], 0.3 * quarter, 1e-14 * quarter);
    EXPECT_EQ(density.values()[density.index(6, 5, 5)], 0);
}

// Boxes far from each other, one of them across a periodic side: as two ranks with one
// each, to the bit, and a marker between them has nothing.
TEST(TouchedRows, of_several_boxes_are_those_of_each) {
    const Grid grid = cut_grid({40, 12, 10}, {true, true, true});
    const CellBox one{{-5, 0, 0}, {6, 12, 10}}, other{{18, 2, 1}, {30, 11, 9}};
    for (const Kernel kernel : all_kernels) {
        TouchedRows both(grid, {one, other}, kernel);
        TouchedRows each[] = {{grid, {one}, kernel}, {grid, {other}, kernel}};
        Random random(11);
        std::vector<Vec3> points;
        for (const double middle : {0.5, 24.5, 11.5}) {  // the last between them
            for (int i = 0; i < 30; ++i)
                points.push_back({grid.spacing_m * (middle + random.between(-1.5, 1.5)),
                                  grid.spacing_m * random.between(4, 8),
                                  grid.spacing_m * random.between(4, 6)});
        }
        const std::vector<Vec3> impulse = random.vectors(points.size(), 1);
        both.place(points);
        std::vector<double> density(3 * both.cells()), expected;
        both.spread(impulse, 1, density);
        std::vector<Vec3> felt(points.size()), sum(points.size());
        both.interpolate(density, felt);
        for (TouchedRows& rows : each) {
            rows.place(points);
            std::vector<double> part(3 * rows.cells());
            rows.spread(impulse, 1, part);
            std::vector<Vec3> share(points.size());
            rows.interpolate(part, share);
            for (std::size_t m = 0; m < share.size(); ++m) sum[m] += share[m];
            expected.insert(expected.end(), part.begin(), part.end());
        }
        EXPECT_EQ(density,
                  expected);  // markers of one box come before those of the other
        EXPECT_EQ(felt, sum);
        EXPECT_NE(felt.front(), Vec3{});
        EXPECT_NE(felt[30], Vec3{});
        EXPECT_EQ(felt.back(), Vec3{});
    }
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

// A fluid that has moved on is audited with what the markers felt before.
TEST(FluidSide, audits_with_the_velocities_that_were_felt) {
    const Grid grid = channel(1);
    const TravellingMarkers markers{grid.spacing_m};
    ArrayFluid fluid{grid, 0};
    FluidSide side{fluid, grid.owned_by_rank[0], kernel, ArrayFluid::step_s};
    const auto points = markers.positions(0);
    side.spread(points, markers.impulses(3));
    const auto felt = side.sample(points);
    InterfaceBalance given;
    const auto impulses = markers.impulses(5);
    for (std::size_t m = 0; m < points.size(); ++m)
        add_marker(given, impulses[m], felt[m]);
    fluid.advance();
    side.spread(points, impulses);
    const auto received = side.received(side.sampled_cells());
    EXPECT_NEAR(received.work_j, given.work_j, 1e-13 * given.work_scale_j);
    EXPECT_GT(std::abs(side.received().work_j - given.work_j), 1e-6 * given.work_scale_j);
}

}  // namespace
}  // namespace magfsi::coupler
