// SPDX-License-Identifier: GPL-2.0-or-later
// The populations of a fluid are the same, to the last bit, on one rank and on several:
// step by step, after a restart, and in steps that are taken again.
#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/parallel/halo.h"
#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

using Planes = std::vector<std::vector<double>>;

// Every plane of this rank's box.
Planes state_of(const Fluid& fluid) {
    const CellBox box = fluid.owned();
    Planes planes;
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        planes.emplace_back(static_cast<std::size_t>(populations_per_cell * box.hi[0] *
                                                     (box.hi[1] - box.lo[1])));
        fluid.populations(z, planes.back());
    }
    return planes;
}

// The cells of a box in the state of a fluid on one rank.
Planes part_of(const Fluid& serial, const CellBox& box) {
    const Planes whole = state_of(serial);
    const int row = populations_per_cell * box.hi[0];
    Planes planes;
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        const auto first = whole[static_cast<std::size_t>(z)].begin();
        planes.emplace_back(first + box.lo[1] * row, first + box.hi[1] * row);
    }
    return planes;
}

// ---- With periodic sides, walls, moving walls, and forces in rows on both sides of a
// cut.

struct Box {
    std::string name;
    std::array<int, 3> cells;
    std::array<bool, 3> periodic;
    bool moving;
    bool body_force;
    Collision collision = Collision::recursive_regularized;
    Precision precision = Precision::double_;
};

FluidConfig config_of(const Box& box) {
    FluidConfig config = lattice_fluid(box.cells, 0.52, box.collision);
    config.precision = box.precision;
    if (box.body_force) config.body_force_n_m3 = Vec3{1e-4, -2e-4, 3e-4};
    for (int side = 0; side < 6; ++side) {
        if (box.periodic[side / 2]) continue;
        config.boundaries[side].kind = BoundaryKind::no_slip;
        if (!box.moving) continue;
        Vec3& wall = config.boundaries[side].wall_velocity_m_s;
        wall[(side / 2 + 1) % 3] = 0.01 * (side + 1);
        wall[(side / 2 + 2) % 3] = -0.02;
    }
    return config;
}

// A state without any symmetry, from the global position alone.
void set_populations(Fluid& fluid) {
    const CellBox box = fluid.owned();
    Planes planes = state_of(fluid);
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        auto& plane = planes[z - box.lo[2]];
        for (std::size_t i = 0; i < plane.size(); ++i) {
            const int q = static_cast<int>(i % populations_per_cell);
            const std::size_t cell = i / populations_per_cell;
            const double x = static_cast<double>(cell % box.hi[0]);
            const double y = static_cast<double>(cell / box.hi[0]) + box.lo[1];
            plane[i] =
                0.1 * d3q19::weight(q) * std::sin(1.1 * x + 2.3 * y + 3.7 * z + 0.9 * q);
        }
        fluid.set_populations(z, plane);
    }
}

// Forces in two thirds of the rows, other ones in every step.
void set_forces(Fluid& fluid, int step) {
    std::vector<CellRow> rows;
    std::vector<double> force;
    for (CellRow row : all_rows(fluid)) {
        if ((row.y + row.z + step) % 3 == 0) continue;
        ++row.x_begin;
        rows.push_back(row);
        for (int i = 0; i < 3 * row.size(); ++i)
            force.push_back(5e-4 * std::sin(i + 2.0 * row.y + 3.0 * row.z + step));
    }
    fluid.set_force(rows, force);
}

class SameOnAnyRanks : public testing::TestWithParam<Box> {};

TEST_P(SameOnAnyRanks, ToTheLastBit) {
    const FluidConfig config = config_of(GetParam());
    Fluid parallel(MPI_COMM_WORLD, config), serial(MPI_COMM_SELF, config);
    set_populations(parallel);
    set_populations(serial);
    for (int step = 0; step < 11; ++step) {
        for (Fluid* fluid : {&parallel, &serial}) {
            set_forces(*fluid, step);
            fluid->step();
        }
        EXPECT_EQ(state_of(parallel), part_of(serial, parallel.owned()))
            << "after step " << step;
    }
    EXPECT_FALSE(serial.diverged());
}

constexpr bool wall = false, wrap = true;

INSTANTIATE_TEST_SUITE_P(
    Boxes, SameOnAnyRanks,
    testing::Values(
        Box{"Periodic", {9, 6, 5}, {wrap, wrap, wrap}, false, false},
        Box{"Walls", {9, 5, 6}, {wall, wall, wall}, false, false},
        Box{"MovingWalls", {13, 6, 6}, {wall, wall, wall}, true, true},
        Box{"ChannelAlongZ", {8, 7, 4}, {wrap, wall, wrap}, true, false},
        Box{"ChannelAlongY", {8, 4, 7}, {wrap, wrap, wall}, true, true},
        Box{"OneRowARank", {5, 3, 2}, {wrap, wrap, wrap}, false, false},
        Box{"ThinWalls", {5, 3, 2}, {wrap, wall, wall}, true, false},
        Box{"Trt", {13, 9, 8}, {wrap, wall, wrap}, true, true, Collision::trt},
        Box{"Float",
            {17, 9, 8},
            {wall, wrap, wrap},
            true,
            true,
            Collision::trt,
            Precision::float_}),
    [](const auto& box) { return box.param.name; });

// ---- A state taken from a fluid on one rank and put into one on several goes on with
// the same populations, from either arrangement.

enum class Sides { periodic, walls, moving_wall, outlet, ramped_inlet };

FluidConfig box(Sides sides, Precision precision) {
    FluidConfig config = lattice_fluid({10, 9, 8}, 0.53, Collision::automatic);
    config.precision = precision;
    if (sides != Sides::periodic) {
        set_walls(config, 0);
        set_walls(config, 1);
    }
    if (sides == Sides::moving_wall)
        config.boundaries[3].wall_velocity_m_s = {0.05, 0, 0.03};
    if (sides == Sides::outlet || sides == Sides::ramped_inlet) {
        config.boundaries[0].kind = BoundaryKind::velocity_inlet;
        config.boundaries[0].inlet.velocity_m_s = {0.02, 0, 0};
        config.boundaries[0].inlet.ramp_s = sides == Sides::ramped_inlet ? 40 : 0;
        config.boundaries[1].kind = BoundaryKind::pressure_outlet;
    }
    config.initial_velocity = stirred;
    return config;
}

void put(Fluid& fluid, const Planes& planes, std::int64_t steps) {
    fluid.set_steps_done(steps);
    int z = fluid.owned().lo[2];
    for (const auto& plane : planes) fluid.set_populations(z++, plane);
}

void expect_same_after(Precision precision, Sides sides, int steps) {
    Fluid serial(MPI_COMM_SELF, box(sides, precision));
    advance(serial, steps);
    Fluid parallel(MPI_COMM_WORLD, box(sides, precision));
    put(parallel, part_of(serial, parallel.owned()), steps);
    EXPECT_EQ(state_of(parallel), part_of(serial, parallel.owned()));
    for (int step = 0; step < 7; ++step) {
        serial.step();
        parallel.step();
        ASSERT_EQ(state_of(parallel), part_of(serial, parallel.owned()))
            << "step " << steps << " + " << step + 1;
    }
}

TEST(State, goes_on_from_either_arrangement) {
    for (const Sides sides : {Sides::periodic, Sides::moving_wall}) {
        for (const int steps : {1, 2, 13})
            expect_same_after(Precision::double_, sides, steps);
    }
}

TEST(State, goes_on_in_single_precision) {
    for (const int steps : {12, 13})
        expect_same_after(Precision::float_, Sides::moving_wall, steps);
}

TEST(State, goes_on_between_a_ramped_inlet_and_an_outlet) {
    for (const int steps : {12, 13})
        expect_same_after(Precision::double_, Sides::ramped_inlet, steps);
}

TEST(State, of_other_planes_is_refused) {
    Fluid fluid(MPI_COMM_SELF, box(Sides::moving_wall, Precision::double_));
    std::vector<double> plane(populations_per_cell * 90);
    EXPECT_NO_THROW(fluid.populations(7, plane));
    EXPECT_THROW(fluid.populations(8, plane), std::invalid_argument);
    EXPECT_THROW(fluid.set_populations(-1, plane), std::invalid_argument);
    plane.pop_back();
    EXPECT_THROW(fluid.set_populations(0, plane), std::invalid_argument);
}

// ---- A step that is taken again with other forces ends where a fluid ends that took it
// with those alone: from either arrangement, whether only the forced rows are swept again
// or the whole state is put back.

// In the rows of this rank that lie in a block across most cuts; another one each time.
void push(Fluid& fluid, int time, int attempt) {
    std::vector<CellRow> rows;
    std::vector<double> force;
    const CellBox own = fluid.owned();
    for (int z = std::max(2, own.lo[2]); z < std::min(7, own.hi[2]); ++z) {
        for (int y = std::max(0, own.lo[1]); y < std::min(6, own.hi[1]); ++y) {
            rows.push_back({y, z, 0, 7});
            for (int i = 0; i < 21; ++i)
                force.push_back(1e-3 *
                                std::sin(1.0 + i + 3 * y + 5 * z + time + 7 * attempt));
        }
    }
    fluid.set_force(rows, force);
}

void expect_same(Sides sides, Precision precision = Precision::double_) {
    Fluid once(MPI_COMM_WORLD, box(sides, precision));
    Fluid again(MPI_COMM_WORLD, box(sides, precision));
    for (int step = 0; step < 6; ++step) {
        again.keep();
        for (int attempt = 2; attempt > 0; --attempt) {
            push(again, step, attempt);
            again.step();
            again.go_back();
        }
        push(again, step, 0);
        again.step();
        push(once, step, 0);
        once.step();
        ASSERT_EQ(state_of(again), state_of(once)) << "step " << step;
        once.step();  // one that is not repeated in between
        again.step();
        ASSERT_EQ(state_of(again), state_of(once)) << "after step " << step;
        if (step % 2 == 0) continue;
        once.step();  // the next one starts from the other arrangement
        again.step();
    }
}

TEST(StepsAgain, in_a_periodic_box) {
    expect_same(Sides::periodic);
}

TEST(StepsAgain, between_walls) {
    expect_same(Sides::walls);
}

TEST(StepsAgain, in_single_precision) {
    expect_same(Sides::walls, Precision::float_);
}

TEST(StepsAgain, beside_a_moving_wall) {
    expect_same(Sides::moving_wall);
}

TEST(StepsAgain, between_an_inlet_and_an_outlet) {
    expect_same(Sides::outlet);
}

// Swept alone, a row must see the force of its own: the first attempt is to leave no
// trace, also not in the cell that was found invalid.
TEST(StepsAgain, an_invalid_cell_of_an_attempt_is_forgotten) {
    Fluid fluid(MPI_COMM_SELF, box(Sides::walls, Precision::double_));
    fluid.keep();
    const std::vector<CellRow> row{{3, 3, 2, 3}};
    fluid.set_force(row, std::vector<double>{1e3, 0, 0});
    fluid.step();
    EXPECT_TRUE(fluid.diverged());
    fluid.go_back();
    fluid.set_force(row, std::vector<double>{1e-3, 0, 0});
    fluid.step();
    EXPECT_FALSE(fluid.diverged());
}

// ---- A rank sends over a cut side the populations that its neighbour will use, and
// nothing over other sides; a box of one cell of depth has rows and ghosts of one cell
// alone.

constexpr int nx = 16, ny = 12;

// Populations of one row that the low rank of two borrows over its cut along y.
double borrowed(const std::array<bool, 3>& periodic) {
    const Decomposition two = decompose({nx, ny, 1}, periodic, 2);
    const RowLayout rows = two.layout(0);
    const Populations populations(rows.nx, rows.row_count(), Precision::double_);
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
        EXPECT_NE(two.neighbour(0, 1, side), no_rank);
        EXPECT_EQ(two.neighbour(0, 2, side), no_rank);
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
