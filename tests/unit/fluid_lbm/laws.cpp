// SPDX-License-Identifier: GPL-2.0-or-later
// Laws that the fluid keeps whatever the collision, on one rank and on two.
#include <omp.h>

#include <numbers>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

// ---- Mass stays, to rounding, in a box whose walls are at rest or move.

class MassIsConserved : public testing::TestWithParam<std::tuple<Collision, Precision>> {
};

TEST_P(MassIsConserved, BetweenWalls) {
    const auto [collision, precision] = GetParam();
    FluidConfig config = lattice_fluid({13, 7, 6}, 0.51, collision);
    config.precision = precision;
    for (int axis = 0; axis < 3; ++axis) set_walls(config, axis);
    config.boundaries[3].wall_velocity_m_s = {0.05, 0, 0.02};
    config.boundaries[0].wall_velocity_m_s = {0, -0.03, 0.01};
    config.body_force_n_m3 = Vec3{1e-5, -2e-5, 1e-5};
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.02 * std::sin(x[1]), 0.02 * std::cos(x[2]), 0.01 * std::sin(x[0])};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const double before = fluid.totals().mass_kg;
    constexpr int steps = 1001;  // ends in the swapped arrangement
    advance(fluid, steps);
    const double change = fluid.totals().mass_kg / before - 1;
    std::printf("%s, %s: relative change of mass over %d steps %.1e\n",
                name_of(collision).data(), name_of(precision).data(), steps, change);
    // Populations of about 1e-3 are rounded by 1e-19 or 6e-11 a step; 19000 roundings of
    // random sign make 1e-17 or 8e-9 of a cell's mass, and cells may agree.
    EXPECT_NEAR(change, 0, precision == Precision::double_ ? 1e-15 : 5e-8);
    EXPECT_FALSE(fluid.diverged());
}

INSTANTIATE_TEST_SUITE_P(All, MassIsConserved,
                         testing::Combine(every_collision, every_precision));

// ---- In a periodic box a step changes the momentum by exactly the impulse of its force,
// and velocity() leaves out the force that has not acted yet.

// Water at 0.1 mm and 10 us, so that the conversion of units is in the test.
FluidConfig stirred_water(Collision collision) {
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
    const FluidConfig config = stirred_water(GetParam());
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
    Fluid fluid(MPI_COMM_WORLD, stirred_water(GetParam()));
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
    FluidConfig config = stirred_water(GetParam());
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

// Uniform force on uniform fluid: after n steps the velocity is n F dt / rho, that before
// the next force acts half a step less.
TEST_P(ForceGivesMomentum, VelocityIsBeforeTheForceActs) {
    FluidConfig config = stirred_water(GetParam());
    config.initial_velocity = nullptr;
    config.body_force_n_m3 = Vec3{1e4, 0, 0};
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int step = 0; step < 4; ++step) {
        for (std::size_t i = 0; const double u : velocity(fluid)) {
            const double expected = i % 3 == 0 ? (step - 0.5) * 1e4 * 1e-5 / 1000 : 0;
            EXPECT_NEAR(u, expected, 1e-16) << "step " << step;  // of at most 3e-4
            ++i;
        }
        EXPECT_NEAR(fluid.totals().max_speed_m_s, step * 1e-4, 1e-16);
        fluid.step();
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, ForceGivesMomentum, every_collision);

// ---- Plane Couette flow: half-way bounce-back with the moving wall's term gives the
// linear profile to rounding, for walls on every axis.

class Couette : public testing::TestWithParam<std::tuple<Collision, int, int>> {};

TEST_P(Couette, ProfileIsLinear) {
    const auto [collision, normal, along] = GetParam();
    constexpr int n = 8;
    std::array<int, 3> cells{5, 4, 4};
    cells[normal] = n;
    FluidConfig config = lattice_fluid(cells, 0.9, collision);
    set_walls(config, normal);
    // The profile is exact at low Mach number only; density varies by u^2.
    constexpr double low = -1e-6, high = 2e-6;
    config.boundaries[2 * normal].wall_velocity_m_s[along] = low;
    config.boundaries[2 * normal + 1].wall_velocity_m_s[along] = high;
    Fluid fluid(MPI_COMM_WORLD, config);
    // The slowest mode decays by exp(-pi^2 nu t / n^2) = exp(-41).
    constexpr int steps = 2001;
    advance(fluid, steps);
    double worst = 0;
    for_each_velocity(fluid, [&, normal, along](const auto& cell, const Vec3& u) {
        const double exact = low + (high - low) * (cell[normal] + 0.5) / n;
        worst = std::max(worst, std::abs(u[along] - exact) / (high - low));
    });
    std::printf("largest error over wall speed: %.1e\n", worst);
    EXPECT_LT(worst, 1e-10);  // rounding of f - w near 1e-7 and the rest of the transient
}

constexpr auto regularized = Collision::recursive_regularized;
INSTANTIATE_TEST_SUITE_P(
    All, Couette,
    testing::Values(std::tuple{Collision::bgk, 0, 1}, std::tuple{Collision::bgk, 1, 2},
                    std::tuple{Collision::bgk, 2, 0}, std::tuple{Collision::trt, 0, 1},
                    std::tuple{Collision::trt, 1, 0}, std::tuple{Collision::trt, 2, 1},
                    std::tuple{regularized, 0, 2}, std::tuple{regularized, 1, 0},
                    std::tuple{regularized, 2, 1}));

// ---- A shear wave carried by a uniform wind decays and keeps its shape as at rest. The
// wind is whole wave lengths over the run, so that the wave returns to its place.

constexpr int wave_length = 32;
constexpr int wave_steps = 640;
constexpr double wind = static_cast<double>(wave_length) / wave_steps;  // 0.05
constexpr double wave_height = 1e-3;

// Velocity along y after the run, of a wave along x, over the initial amplitude: cosine
// and sine part.
std::array<double, 2> final_wave(Collision collision, double relaxation_time,
                                 const Vec3& stream) {
    constexpr int n = wave_length;
    constexpr double k = 2 * std::numbers::pi / n;
    FluidConfig config = lattice_fluid({n, 4, 4}, relaxation_time, collision);
    config.initial_velocity = [&](const Vec3& x) {
        return Vec3{stream[0], stream[1] + wave_height * std::cos(k * x[0]), stream[2]};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    advance(fluid, wave_steps);
    const std::vector<double> u = velocity(fluid);
    std::array<double, 2> wave{};
    for (int x = 0; x < n; ++x) {
        wave[0] += 2.0 / n * u[3 * x + 1] * std::cos(k * (x + 0.5)) / wave_height;
        wave[1] += 2.0 / n * u[3 * x + 1] * std::sin(k * (x + 0.5)) / wave_height;
    }
    return wave;
}

bool is_recursive(Collision collision) {
    return collision == Collision::recursive_regularized ||
           collision == Collision::recursive_mrt;
}

class GalileanInvariance : public testing::TestWithParam<Collision> {};

TEST_P(GalileanInvariance, OfAShearWave) {
    const auto rest = final_wave(GetParam(), 0.6, {});
    const auto carried = final_wave(GetParam(), 0.6, {wind, 0, 0});
    std::printf("amplitude at rest %.5f, carried %.5f, out of phase %.5f\n", rest[0],
                carried[0], carried[1]);
    // The second-order equilibrium of BGK and TRT lacks the third moment: its viscosity
    // falls by 3 U^2 = 0.75 %, times an exponent of 0.83. The recursive third order
    // restores it for this flow up to dispersion, of order (k dx)^4.
    EXPECT_NEAR(carried[0] / rest[0], 1, is_recursive(GetParam()) ? 1e-3 : 0.008);
    // Two relaxation times: advection is exact to third order only for Lambda = 1/12; at
    // 3/16 the wave is shifted by (3/16 - 1/12) k^3 a cell and terms of higher order:
    // 0.025 over 32 cells in the lowest.
    const bool trt = GetParam() == Collision::trt;
    EXPECT_NEAR(carried[1] / rest[0], 0, trt ? 0.03 : 1e-3);
}

// At small viscosities a stream must not make the fluid thicker either: odd modes that
// relax slowly and couple to others that do not (three of six with a magic number of 1/4)
// added 8 % here, 30 % at twice the speed and half the length, and with that a cylinder's
// wake did not shed at Reynolds number 200.
TEST_P(GalileanInvariance, OfTheViscosityInAStream) {
    for (const double tau : {0.507, 0.52}) {
        const double at_rest = std::log(final_wave(GetParam(), tau, {})[0]);
        for (const Vec3& stream : {Vec3{2 * wind, 0, 0}, Vec3{0, 2 * wind, 0}}) {
            const auto wave = final_wave(GetParam(), tau, stream);
            const double ratio = std::log(std::hypot(wave[0], wave[1])) / at_rest;
            std::printf("tau %.3f, stream along %c: viscosity over that at rest %.4f\n",
                        tau, stream[0] > 0 ? 'x' : 'y', ratio);
            // 3 U^2 = 3 % of BGK and TRT, see above, of which an odd rate of 1 makes one
            // and a half times as much; of the others (k dx)^4 = 0.15 %.
            EXPECT_NEAR(ratio, 1, is_recursive(GetParam()) ? 0.01 : 0.05);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, GalileanInvariance, every_collision);

// ---- Populations after some steps are the same, to the last bit, for any number of
// threads, and so is the cell that is named when one goes wrong.

struct Outcome {
    std::vector<double> velocity;
    std::optional<Divergence> diverged;
};

Outcome run(int threads, double amplitude, int steps) {
    const int usual_threads = omp_get_max_threads();
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
    omp_set_num_threads(usual_threads);  // of the tests that follow
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
    EXPECT_TRUE(on_any_rank(one.diverged.has_value()));
    for (const int threads : {2, 3, 5}) {
        const Outcome many = run(threads, 0.5, 1);
        ASSERT_EQ(many.diverged.has_value(), one.diverged.has_value());
        if (one.diverged) {
            EXPECT_EQ(many.diverged->cell, one.diverged->cell);
        }
    }
}

// What a step leaves out beside sides that are filled anew never comes further than two
// cells in two steps, to the last bit.
TEST(RefilledSides, KeepWhatTheyLeaveOutToThemselves) {
    FluidConfig config =
        lattice_fluid({13, 9, 8}, 0.51, Collision::recursive_regularized);
    for (int axis = 0; axis < 3; ++axis) set_walls(config, axis);
    config.initial_velocity = [](const Vec3& at) {
        return Vec3{0.05 * std::sin(at[1] + at[2]), 0.04 * std::cos(at[0]),
                    0.03 * std::sin(at[0] + at[1])};
    };
    Fluid whole(MPI_COMM_SELF, config);
    config.refilled.fill(true);
    Fluid patch(MPI_COMM_SELF, config);
    for (int step = 1; step <= 2; ++step) {
        whole.step();
        patch.step();
        ASSERT_FALSE(patch.diverged());
        std::vector<Vec3> expected;
        for_each_velocity(whole,
                          [&](const auto&, const Vec3& u) { expected.push_back(u); });
        std::size_t i = 0;
        for_each_velocity(patch, [&](const std::array<int, 3>& cell, const Vec3& u) {
            const Vec3& there = expected[i++];
            for (int d = 0; d < 3; ++d)
                if (cell[d] < 2 || cell[d] >= config.cells[d] - 2) return;
            EXPECT_EQ(u, there) << cell[0] << ", " << cell[1] << ", " << cell[2];
        });
    }
}

}  // namespace
}  // namespace magfsi::fluid
