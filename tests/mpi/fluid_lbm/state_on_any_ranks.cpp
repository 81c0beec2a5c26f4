// A state taken from a fluid on one rank and put into one on several goes on with the
// same populations, to the last bit, from either arrangement.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

constexpr std::array<int, 3> cells{10, 6, 6};

FluidConfig channel(Precision precision, bool openings) {
    FluidConfig config = lattice_fluid(cells, 0.53, Collision::automatic);
    config.precision = precision;
    set_walls(config, 1);
    config.boundaries[3].wall_velocity_m_s = {0.05, 0, 0.03};
    if (openings) {
        config.boundaries[0].kind = BoundaryKind::velocity_inlet;
        config.boundaries[0].inlet = {{0.02, 0, 0}, InletProfile::uniform, 40, {}};
        config.boundaries[1].kind = BoundaryKind::pressure_outlet;
    }
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.02 * std::sin(x[1] + x[2]), 0.02 * std::cos(x[0]), 0.01 * x[1] / 6};
    };
    return config;
}

using Planes = std::vector<std::vector<double>>;

// Every plane of this rank's box.
Planes state_of(const Fluid& fluid) {
    const CellBox box = fluid.owned();
    Planes planes;
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        planes.emplace_back(static_cast<std::size_t>(populations_a_cell * cells[0] *
                                                     (box.hi[1] - box.lo[1])));
        fluid.populations(z, planes.back());
    }
    return planes;
}

// The cells of a box in the state of a fluid on one rank.
Planes part(const Planes& whole, const CellBox& box) {
    const int row = populations_a_cell * cells[0];
    Planes planes;
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        const auto first = whole[static_cast<std::size_t>(z)].begin();
        planes.emplace_back(first + box.lo[1] * row, first + box.hi[1] * row);
    }
    return planes;
}

void put(Fluid& fluid, const Planes& planes, std::int64_t steps) {
    fluid.set_steps_done(steps);
    int z = fluid.owned().lo[2];
    for (const auto& plane : planes) fluid.set_populations(z++, plane);
}

void expect_same_after(Precision precision, bool openings, int steps) {
    Fluid serial(MPI_COMM_SELF, channel(precision, openings));
    for (int step = 0; step < steps; ++step) serial.step();
    Fluid parallel(MPI_COMM_WORLD, channel(precision, openings));
    put(parallel, part(state_of(serial), parallel.owned()), steps);
    EXPECT_EQ(parallel.steps_done(), steps);
    EXPECT_EQ(state_of(parallel), part(state_of(serial), parallel.owned()));
    for (int step = 0; step < 7; ++step) {
        serial.step();
        parallel.step();
        ASSERT_EQ(state_of(parallel), part(state_of(serial), parallel.owned()))
            << "step " << steps << " + " << step + 1;
    }
}

TEST(State, goes_on_from_either_arrangement) {
    for (const int steps : {1, 2, 12, 13})
        expect_same_after(Precision::double_, false, steps);
}

TEST(State, goes_on_in_single_precision) {
    for (const int steps : {12, 13}) expect_same_after(Precision::float_, false, steps);
}

TEST(State, goes_on_between_a_ramped_inlet_and_an_outlet) {
    for (const int steps : {12, 13}) expect_same_after(Precision::double_, true, steps);
}

TEST(State, of_other_planes_is_refused) {
    Fluid fluid(MPI_COMM_SELF, channel(Precision::double_, false));
    std::vector<double> plane(populations_a_cell * 60);
    EXPECT_NO_THROW(fluid.populations(5, plane));
    EXPECT_THROW(fluid.populations(6, plane), std::invalid_argument);
    EXPECT_THROW(fluid.set_populations(-1, plane), std::invalid_argument);
    plane.pop_back();
    EXPECT_THROW(fluid.set_populations(0, plane), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::fluid
