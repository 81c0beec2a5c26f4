// The populations after any number of steps are the same, to the last bit, on one rank
// and on several: with periodic sides, walls, moving walls, and forces in rows on both
// sides of a cut.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid_lbm/solver.h"
#include "fluid_lbm/streaming/kernel_choice.h"

namespace magfsi::fluid {
namespace {

struct Case {
    std::string name;
    std::array<int, 3> cells;
    std::array<bool, 3> periodic;
    bool moving;
    bool body_force;
    Collision collision = Collision::recursive_regularized;
    Precision precision = Precision::double_;
};

SolverConfig solver_config(const Case& c) {
    SolverConfig config;
    config.cells = c.cells;
    config.periodic = c.periodic;
    config.collision.omega = 1 / 0.52;
    config.kernels =
        run_kernels(choose_kernels().kernels, c.precision, c.collision, false);
    if (c.body_force) config.body_force = {1e-4, -2e-4, 3e-4};
    for (int side = 0; side < 6 && c.moving; ++side) {
        if (c.periodic[side / 2]) continue;
        config.wall_velocity[side][(side / 2 + 1) % 3] = 0.01 * (side + 1);
        config.wall_velocity[side][(side / 2 + 2) % 3] = -0.02;
    }
    return config;
}

// A state without any symmetry, from the global position alone.
void set_populations(const Solver& solver) {
    const RowLayout& rows = solver.layout();
    const CellBox& box = solver.owned();
    solver.populations().visit([&]<class Real>(const PopulationRows<Real>& values) {
        for (int z = 0; z < rows.nz; ++z) {
            for (int y = 0; y < rows.ny; ++y) {
                for (int q = 0; q < d3q19::directions; ++q) {
                    Real* row = values.row(q, rows.row(y, z));
                    const double phase = 2.3 * (y + box.lo[1]) + 3.7 * (z + box.lo[2]);
                    for (int x = 0; x < rows.nx; ++x) {
                        row[x] = static_cast<Real>(0.1 * d3q19::weight(q) *
                                                   std::sin(1.1 * x + phase + 0.9 * q));
                    }
                }
            }
        }
    });
}

// Forces in two thirds of the rows of the middle, other ones in every step.
void set_forces(Solver& solver, int step) {
    const CellBox& box = solver.owned();
    const auto& cells = solver.decomposition().cells;
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            if ((y + z + step) % 3 == 0) continue;
            std::vector<double> force;
            for (int i = 0; i < 3 * (cells[0] - 1); ++i) {
                force.push_back(1e-3 * std::sin(i + 2.0 * y + 3.0 * z + step));
            }
            solver.forces().add(y - box.lo[1], z - box.lo[2], 1, force, 0.5);
        }
    }
}

// Number of populations of this rank that differ from those of a run on one rank.
int differences(const Solver& parallel, const Solver& serial) {
    const RowLayout& rows = parallel.layout();
    const CellBox& box = parallel.owned();
    int count = 0;
    for (int z = 0; z < rows.nz; ++z) {
        for (int y = 0; y < rows.ny; ++y) {
            for (int x = 0; x < rows.nx; ++x) {
                for (int q = 0; q < d3q19::directions; ++q) {
                    const double here = population(parallel.view(), q, x, y, z);
                    const double there =
                        population(serial.view(), q, x, y + box.lo[1], z + box.lo[2]);
                    count += here != there || std::isnan(here);
                }
            }
        }
    }
    return count;
}

class SameOnAnyRanks : public testing::TestWithParam<Case> {};

TEST_P(SameOnAnyRanks, ToTheLastBit) {
    const SolverConfig config = solver_config(GetParam());
    Solver parallel(MPI_COMM_WORLD, config), serial(MPI_COMM_SELF, config);
    set_populations(parallel);
    set_populations(serial);
    for (int step = 0; step < 11; ++step) {
        set_forces(parallel, step);
        set_forces(serial, step);
        parallel.step();
        serial.step();
        EXPECT_EQ(differences(parallel, serial), 0) << "after step " << step;
    }
}

constexpr bool wall = false, wrap = true;

INSTANTIATE_TEST_SUITE_P(
    Boxes, SameOnAnyRanks,
    testing::Values(
        Case{"Periodic", {9, 6, 5}, {wrap, wrap, wrap}, false, false},
        Case{"Walls", {9, 5, 6}, {wall, wall, wall}, false, false},
        Case{"MovingWalls", {13, 6, 6}, {wall, wall, wall}, true, true},
        Case{"ChannelAlongZ", {8, 7, 4}, {wrap, wall, wrap}, true, false},
        Case{"ChannelAlongY", {8, 4, 7}, {wrap, wrap, wall}, true, true},
        Case{"OneRowARank", {5, 3, 2}, {wrap, wrap, wrap}, false, false},
        Case{"ThinWalls", {5, 3, 2}, {wrap, wall, wall}, true, false},
        Case{"Trt", {13, 9, 8}, {wrap, wall, wrap}, true, true, Collision::trt},
        Case{"Float",
             {17, 9, 8},
             {wall, wrap, wrap},
             true,
             true,
             Collision::trt,
             Precision::float_},
        Case{"FloatDouble",
             {17, 8, 9},
             {wrap, wrap, wall},
             false,
             true,
             Collision::bgk,
             Precision::float_double}),
    [](const auto& box) { return box.param.name; });

}  // namespace
}  // namespace magfsi::fluid
