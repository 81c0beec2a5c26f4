// Populations after some steps are the same, to the last bit, for any number of threads,
// and so is the cell that is named when one goes wrong.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

struct Outcome {
    std::vector<double> velocity;
    std::optional<Divergence> diverged;
};

Outcome run(int threads, double amplitude, int steps) {
    omp_set_num_threads(threads);
    FluidConfig config = lattice_fluid({17, 9, 7}, 0.55, Collision::automatic);
    set_walls(config, 1);
    config.boundaries[2].wall_velocity_m_s = {0.05, 0, 0.02};
    config.initial_velocity = [&](const Vec3& x) {
        return Vec3{amplitude * std::sin(x[1] + x[2]), 0.02 * std::cos(x[0]), 0.01};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int step = 0; step < steps; ++step) {
        const std::vector<CellRow> rows = all_rows(fluid);
        std::vector<double> force;
        for (int i = 0; i < 3 * 17; ++i) force.push_back(1e-4 * std::sin(i + step));
        fluid.set_force(std::span(rows).first(1), force);
        fluid.step();
    }
    return {velocity(fluid), fluid.diverged()};
}

TEST(SameForAnyThreads, ToTheLastBit) {
    const Outcome one = run(1, 0.02, 21);
    EXPECT_FALSE(one.diverged);
    for (const int threads : {2, 3, 5}) {
        EXPECT_EQ(run(threads, 0.02, 21).velocity, one.velocity) << threads;
    }
}

TEST(SameForAnyThreads, NamesTheSameCell) {
    const Outcome one = run(1, 0.5, 1);  // too fast in many rows
    int any = one.diverged.has_value();
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_EQ(any, 1);
    for (const int threads : {2, 3, 5}) {
        const Outcome many = run(threads, 0.5, 1);
        ASSERT_EQ(many.diverged.has_value(), one.diverged.has_value());
        if (one.diverged) {
            EXPECT_EQ(many.diverged->cell, one.diverged->cell);
        }
    }
}

}  // namespace
}  // namespace magfsi::fluid
