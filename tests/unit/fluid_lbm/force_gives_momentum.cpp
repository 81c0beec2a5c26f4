// In a periodic box a step changes the momentum by exactly the impulse of its force, and
// velocity() leaves out the force that has not acted yet.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

// Water at 0.1 mm and 10 us, so that the conversion of units is in the test.
FluidConfig water(Collision collision) {
    FluidConfig config;
    config.cells = {13, 6, 5};
    config.spacing_m = 1e-4;
    config.time_step_s = 1e-5;
    config.density_kg_m3 = 1000;
    config.viscosity_m2_s = 1e-6;
    config.collision = collision;
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.1 * std::sin(1e4 * x[1]), 0.05, 0.1 * std::cos(2e4 * x[0])};
    };
    return config;
}

// Every other owned row in part, with a force that differs from cell to cell.
struct Load {
    std::vector<CellRow> rows;
    std::vector<double> force;
    Vec3 sum{};

    Load(const Fluid& fluid, int step) {
        for (const CellRow& row : all_rows(fluid)) {
            if ((row.y + row.z) % 2 == 0) rows.push_back({row.y, row.z, 2, 11});
        }
        for (const CellRow& row : rows) {
            for (int i = 0; i < 3 * row.size(); ++i) {
                force.push_back(2e4 * std::sin(i + 3.0 * row.y + 5.0 * row.z + step));
                sum[i % 3] += force.back();
            }
        }
        MPI_Allreduce(MPI_IN_PLACE, sum.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    }
};

class ForceGivesMomentum : public testing::TestWithParam<Collision> {};

TEST_P(ForceGivesMomentum, InEveryStep) {
    const FluidConfig config = water(GetParam());
    Fluid fluid(MPI_COMM_WORLD, config);
    const double volume_time = std::pow(config.spacing_m, 3) * config.time_step_s;
    double worst = 0;
    for (int step = 0; step < 6; ++step) {
        const Load load(fluid, step);
        fluid.set_force(load.rows, load.force);
        const Vec3 before = fluid.totals().momentum_kg_m_s;
        fluid.step();
        const Vec3 after = fluid.totals().momentum_kg_m_s;
        double scale = 0, error = 0;
        for (int a = 0; a < 3; ++a) {
            const double impulse = load.sum[a] * volume_time;
            scale = std::max(scale, std::abs(impulse) + std::abs(before[a]));
            error = std::max(error, std::abs(after[a] - before[a] - impulse));
        }
        worst = std::max(worst, error / scale);
    }
    std::printf("momentum against impulse, relative: %.1e\n", worst);
    EXPECT_LT(worst, 1e-12);  // rounding of a sum over 390 cells
}

TEST_P(ForceGivesMomentum, OnceOnly) {
    Fluid fluid(MPI_COMM_WORLD, water(GetParam()));
    const Load load(fluid, 0);
    fluid.set_force(load.rows, load.force);
    fluid.step();
    const Vec3 before = fluid.totals().momentum_kg_m_s;
    fluid.step();
    const Vec3 after = fluid.totals().momentum_kg_m_s;
    double scale = 0;
    for (int a = 0; a < 3; ++a) scale = std::max(scale, std::abs(before[a]));
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(after[a], before[a], 1e-12 * scale);
}

TEST_P(ForceGivesMomentum, BodyForceActsInEveryCellAndAddsToOthers) {
    FluidConfig config = water(GetParam());
    config.initial_velocity = nullptr;
    config.body_force_n_m3 = Vec3{1e4, -2e4, 3e4};
    Fluid fluid(MPI_COMM_WORLD, config);
    const Load load(fluid, 1);
    fluid.set_force(load.rows, load.force);
    fluid.step();
    fluid.step();
    const double volume_time = std::pow(config.spacing_m, 3) * config.time_step_s;
    const Vec3 momentum = fluid.totals().momentum_kg_m_s;
    for (int a = 0; a < 3; ++a) {
        const double cells = 13 * 6 * 5;
        const double expected =
            volume_time * (load.sum[a] + 2 * cells * (*config.body_force_n_m3)[a]);
        EXPECT_NEAR(momentum[a], expected, 1e-12 * std::abs(expected));
    }
}

// Uniform force on uniform fluid: velocity is n F dt / rho after n steps, not n + 1/2.
TEST_P(ForceGivesMomentum, VelocityIsBeforeTheForceActs) {
    FluidConfig config = water(GetParam());
    config.initial_velocity = nullptr;
    config.body_force_n_m3 = Vec3{1e4, 0, 0};
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int step = 0; step < 4; ++step) {
        for (std::size_t i = 0; const double u : velocity(fluid)) {
            const double expected = i % 3 == 0 ? step * 1e4 * 1e-5 / 1000 : 0;
            EXPECT_NEAR(u, expected, 1e-16) << "step " << step;  // of at most 3e-4
            ++i;
        }
        fluid.step();
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, ForceGivesMomentum,
                         testing::Values(Collision::bgk, Collision::trt,
                                         Collision::recursive_regularized));

}  // namespace
}  // namespace magfsi::fluid
