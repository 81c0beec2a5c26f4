// SPDX-License-Identifier: GPL-2.0-or-later
// A nest of patches for each body: two that are apart, come near each other and part
// again, on any number of ranks.
#include "tests/mpi/fluid_lbm/stirred_box.h"

namespace magfsi::fluid {
namespace {

// Long enough for two nests.
RefinedConfig long_box(int levels) {
    RefinedConfig config = stirred_box(levels);
    config.coarse.cells = {58, 24, 24};
    return config;
}

// One body stays, another comes from afar, close to it, and goes back.
constexpr double there_and_back = 24;
std::vector<BodyBox> visit(double time) {
    const double x = 33 + 9 * std::cos(2 * std::numbers::pi * time / there_and_back);
    const auto around = [](double at) {
        return BodyBox{Vec3{at - 1.5, 10.8, 10}, Vec3{at + 1.5, 13.2, 12}};
    };
    return {around(16), around(x)};
}

class Nests : public testing::TestWithParam<int> {
  protected:
    const RefinedConfig config_ = long_box(GetParam());
    const int steps_in_one_ = 1 << GetParam();
};

TEST_P(Nests, MergeAndPartOnAnyRanksAndKeepTheMass) {
    RefinedFluid parallel(MPI_COMM_WORLD, config_, visit(0));
    RefinedFluid serial(MPI_COMM_SELF, config_, visit(0));
    const double mass = parallel.totals().mass_kg;
    std::vector<int> nests;
    for (int i = 0; i < there_and_back; ++i) {
        run(parallel, MPI_COMM_WORLD, i * steps_in_one_, (i + 1) * steps_in_one_, visit);
        run(serial, MPI_COMM_SELF, i * steps_in_one_, (i + 1) * steps_in_one_, visit);
        EXPECT_NEAR(parallel.totals().mass_kg / mass, 1, 1e-14) << i;
        if (nests.empty() || nests.back() != parallel.nests())
            nests.push_back(parallel.nests());
    }
    EXPECT_EQ(nests, (std::vector{2, 1, 2}));
    expect_same(parallel, serial, 1e-15);
    EXPECT_NEAR(parallel.totals().kinetic_energy_j, serial.totals().kinetic_energy_j,
                1e-12 * serial.totals().kinetic_energy_j);
    EXPECT_NEAR(parallel.enstrophy_1_s2(), serial.enstrophy_1_s2(),
                1e-12 * serial.enstrophy_1_s2());
}

// With two nests and with one, before and in the middle of steps of the coarser levels.
TEST_P(Nests, GoOnFromAStateThatIsPutBack) {
    for (const int middle : {3 * steps_in_one_, 11 * steps_in_one_ + 1})
        expect_it_goes_on(config_, visit, middle, middle + 4 * steps_in_one_);
}

TEST_P(Nests, TakeAStepAgain) {
    expect_steps_taken_again(config_, visit(0), 3 * steps_in_one_);
}

INSTANTIATE_TEST_SUITE_P(OneToTwo, Nests, testing::Values(1, 2));

// A nest that stays is not made anew when another one moves.
TEST(Nest, StaysWhereItIsWhileAnotherMoves) {
    const FluidConfig coarse = long_box(2).coarse;
    const PatchRule rule{.levels = 2, .margin_cells = 1};
    const auto before = place_nests(coarse, rule, visit(0), nullptr);
    ASSERT_TRUE(before && before->size() == 2);
    EXPECT_FALSE(place_nests(coarse, rule, visit(0.5), &*before));
    const auto after = place_nests(coarse, rule, visit(4), &*before);
    ASSERT_TRUE(after && after->size() == 2);
    EXPECT_EQ((*after)[0], (*before)[0]);
    EXPECT_NE((*after)[1], (*before)[1]);
    EXPECT_EQ((*after)[1].back().stored.hi[0] - (*after)[1].back().stored.lo[0],
              (*before)[1].back().stored.hi[0] - (*before)[1].back().stored.lo[0]);
}

// Cells of level 0 between what nests cover, whichever way around.
TEST(Nest, KeepsItsDistanceFromOthersAlsoAcrossPeriodicSides) {
    FluidConfig coarse = long_box(1).coarse;
    for (auto& side : coarse.boundaries) side.kind = BoundaryKind::periodic;
    const PatchRule rule{.levels = 1, .margin_cells = 1};
    const auto at = [](double x) {
        return BodyBox{Vec3{x - 1, 10, 10}, Vec3{x + 1, 12, 12}};
    };
    for (double x = 0; x < 2 * 58; x += 0.7) {
        const auto nests = *place_nests(coarse, rule, {at(29), at(x)}, nullptr);
        const double away = std::abs(std::remainder(x - 29, 58));
        // 2 cells of the bodies, 2 x 2 of margins and slack, and one for their places.
        const double apart = 2 + 4 + between_nests_cells;
        if (away > apart + 1) {
            EXPECT_EQ(nests.size(), 2u) << x;
        }
        if (away < apart - 1) {
            EXPECT_EQ(nests.size(), 1u) << x;
        }
        // Those that share one share the shorter way.
        if (nests.size() == 1) {
            const CellBox covered = nests[0][0].covered();
            EXPECT_LE(covered.hi[0] - covered.lo[0], away + 2 + 4 + 3) << x;
        }
    }
}

// Nests of three bodies of which two are near the third.
TEST(Nest, HoldsAllThatAreNearOneAnother) {
    const FluidConfig coarse = long_box(1).coarse;
    const PatchRule rule{.levels = 1, .margin_cells = 1};
    const auto at = [](double x) {
        return BodyBox{Vec3{x - 1, 10, 10}, Vec3{x + 1, 12, 12}};
    };
    EXPECT_EQ(place_nests(coarse, rule, {at(10), at(48)}, nullptr)->size(), 2u);
    EXPECT_EQ(place_nests(coarse, rule, {at(10), at(48), at(40)}, nullptr)->size(), 2u);
    EXPECT_EQ(place_nests(coarse, rule, {at(10), at(34), at(22)}, nullptr)->size(), 1u);
}

}  // namespace
}  // namespace magfsi::fluid
