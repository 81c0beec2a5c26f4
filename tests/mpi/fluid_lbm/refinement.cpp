// SPDX-License-Identifier: GPL-2.0-or-later
// A refined grid is the same on any number of ranks, keeps its mass, and goes on from a
// state that was put back; places of patches.
#include "tests/mpi/fluid_lbm/stirred_box.h"
#include "tests/support/carried_vortex.h"

namespace magfsi::fluid {
namespace {

class Levels : public testing::TestWithParam<int> {};

// Sums of the mass are in another order, which shifts what keeps it by a rounding.
TEST_P(Levels, AreTheSameOnAnyRanks) {
    RefinedFluid parallel(MPI_COMM_WORLD, stirred_box(GetParam()), body_at(0));
    RefinedFluid serial(MPI_COMM_SELF, stirred_box(GetParam()), body_at(0));
    const int steps = 40 << GetParam();
    run(parallel, MPI_COMM_WORLD, 0, steps);
    run(serial, MPI_COMM_SELF, 0, steps);
    EXPECT_GT(parallel.moves(), 3);
    EXPECT_EQ(parallel.moves(), serial.moves());
    expect_same(parallel, serial, 1e-15);
    EXPECT_NEAR(parallel.totals().kinetic_energy_j, serial.totals().kinetic_energy_j,
                1e-12 * serial.totals().kinetic_energy_j);
    EXPECT_NEAR(parallel.enstrophy_1_s2(), serial.enstrophy_1_s2(),
                1e-12 * serial.enstrophy_1_s2());
}

TEST_P(Levels, KeepTheMassOfAClosedBox) {
    RefinedFluid fluid(MPI_COMM_WORLD, stirred_box(GetParam()), body_at(0));
    const double mass = fluid.totals().mass_kg;
    for (int part = 0; part < 3; ++part) {
        run(fluid, MPI_COMM_WORLD, part * (24 << GetParam()),
            (part + 1) * (24 << GetParam()));
        EXPECT_NEAR(fluid.totals().mass_kg / mass, 1, 1e-14);
    }
}

// A patch that covers the whole of a periodic box has no sides: what its moves add goes
// through those of the next.
TEST(Refinement, KeepsTheMassOfAPeriodicBoxThatAPatchCovers) {
    RefinedConfig config = stirred_box(2);
    config.coarse.cells = {14, 14, 14};
    for (auto& side : config.coarse.boundaries) side.kind = BoundaryKind::periodic;
    const auto around = [](int i) {
        const double x = 7 + 2 * std::sin(i / 7.0);
        return std::vector<BodyBox>{{Vec3{x - 2, 5, 5}, Vec3{x + 2, 9, 9}}};
    };
    RefinedFluid fluid(MPI_COMM_WORLD, config, around(0));
    const double mass = fluid.totals().mass_kg;
    for (int i = 0; i < 60; ++i) {
        fluid.follow(around(i));
        for (int part = 0; part < 4; ++part) fluid.step();
        EXPECT_NEAR(fluid.totals().mass_kg / mass, 1, 1e-13) << i;
    }
    EXPECT_GT(fluid.moves(), 3);
    for (int d = 0; d < 3; ++d) EXPECT_GT(fluid.place(1).period[d], 0);
}

// A ball that patches meet, leave and cut.
TEST_P(Levels, AreTheSameOnAnyRanksAtAnObstacle) {
    RefinedConfig config = stirred_box(GetParam());
    config.coarse.obstacles.push_back({"ball", Sphere{{19.3, 14.2, 12.1}, 6}});
    RefinedFluid parallel(MPI_COMM_WORLD, config, body_at(0));
    RefinedFluid serial(MPI_COMM_SELF, config, body_at(0));
    const int steps = 12 << GetParam();
    run(parallel, MPI_COMM_WORLD, 0, steps);
    run(serial, MPI_COMM_SELF, 0, steps);
    EXPECT_GE(parallel.moves(), 3);
    expect_same(parallel, serial, 1e-15);
    const Vec3 force = parallel.obstacle_forces()[0], same = serial.obstacle_forces()[0];
    for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(force[a], same[a], 1e-14);
    EXPECT_GT(std::abs(force[0]), 1e-6);
}

// Before and in the middle of steps of the coarser levels.
TEST_P(Levels, GoOnFromAStateThatIsPutBack) {
    for (const int middle : {16 << GetParam(), (16 << GetParam()) + 1})
        expect_it_goes_on(stirred_box(GetParam()), body_at, middle, 2 * middle);
}

TEST_P(Levels, TakeAStepAgain) {
    expect_steps_taken_again(stirred_box(GetParam()), body_at(0), 5 << GetParam());
}

INSTANTIATE_TEST_SUITE_P(OneToThree, Levels, testing::Values(1, 2));

TEST(Refinement, IsCloseInSinglePrecision) {
    RefinedFluid in_double(MPI_COMM_WORLD, stirred_box(1), body_at(0));
    RefinedFluid in_float(MPI_COMM_WORLD, stirred_box(1, Precision::float_), body_at(0));
    run(in_double, MPI_COMM_WORLD, 0, 32);
    run(in_float, MPI_COMM_WORLD, 0, 32);
    const double expected = in_double.totals().kinetic_energy_j;
    EXPECT_NEAR(in_float.totals().kinetic_energy_j, expected, 1e-5 * expected);
}

TEST(Patches, LieAroundTheBodiesAndWithinEachOther) {
    const FluidConfig config = stirred_box(1).coarse;
    for (int levels = 1; levels <= 3; ++levels) {
        const auto places = place_nests(config, {.levels = levels, .margin_cells = 1},
                                        body_at(0), nullptr);
        ASSERT_TRUE(places);
        const LevelPlace* below = nullptr;
        for (const LevelPlace& place : places->front()) {
            for (int d = 0; d < 3 && below; ++d) {
                const CellBox covered = place.covered();
                EXPECT_TRUE(covered.lo[d] == 0 ||
                            covered.lo[d] >= below->inside.lo[d] + apart_cells);
                EXPECT_TRUE(covered.hi[d] == below->domain[d] ||
                            covered.hi[d] <= below->inside.hi[d] - apart_cells);
            }
            below = &place;
        }
        // Who stays near needs no other places.
        EXPECT_FALSE(place_nests(config, {.levels = levels, .margin_cells = 1},
                                 body_at(0.1), &*places));
    }
}

TEST(Patches, AreRefusedAtInlets) {
    RefinedConfig config;
    config.coarse = channel({40, 20, 20}, 0.6, 0, 0.01, BoundaryKind::no_slip);
    expect_refused(
        [&] {
            RefinedFluid(MPI_COMM_WORLD, config, {{Vec3{2, 8, 8}, Vec3{6, 12, 12}}});
        },
        "reaches the velocity_inlet at x_min");
}

}  // namespace
}  // namespace magfsi::fluid
