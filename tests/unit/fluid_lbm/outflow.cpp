// SPDX-License-Identifier: GPL-2.0-or-later
// Sides whose given velocity points out of the box.
#include <algorithm>
#include <numbers>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

// In by a side and out by the opposite one, both with the given velocity.
FluidConfig through_flow(std::array<int, 3> cells, double relaxation_time, int in,
                         double speed) {
    FluidConfig config =
        channel(cells, relaxation_time, in, speed, BoundaryKind::no_slip);
    Boundary& out = config.boundaries[in % 2 == 0 ? in + 1 : in - 1];
    out.kind = BoundaryKind::velocity_inlet;
    out.inlet = config.boundaries[in].inlet;
    return config;
}

// ---- A parabola that leaves keeps its shape up to the side: Poiseuille flow.

class ParabolaLeaves : public testing::TestWithParam<int> {};

TEST_P(ParabolaLeaves, AsItCame) {
    const int in = GetParam(), axis = in / 2, across = (axis + 1) % 3;
    constexpr int height = 12;
    constexpr double mean = 1e-3;  // so slow that density is constant to 0.06 %
    std::array<int, 3> cells{2, 2, 2};
    cells[axis] = 24;
    cells[across] = height;
    FluidConfig config = through_flow(cells, 0.8, in, mean);
    for (int side : {in, in % 2 == 0 ? in + 1 : in - 1}) {
        config.boundaries[side].inlet.profile = InletProfile::parabolic;
        config.boundaries[side].inlet.ramp_s = 100;
    }
    const int third = 3 - axis - across;
    for (int side : {2 * third, 2 * third + 1})
        config.boundaries[side].kind = BoundaryKind::periodic;
    Fluid fluid(MPI_COMM_WORLD, config);
    advance(fluid, 6000);  // diffusion takes height^2 / (pi^2 nu) = 146 steps
    double worst = 0;
    for_each_velocity(fluid, [&](const std::array<int, 3>& cell, const Vec3& u) {
        const double s = (cell[across] + 0.5) * 2 / height - 1;
        const double along = (in % 2 == 0 ? 1 : -1) * u[axis];
        worst = std::max(worst, std::abs(along - 1.5 * mean * (1 - s * s)) / mean);
    });
    std::printf("in by side %d: largest error %.2e\n", in, worst);
    // Half-way walls and links are second order: (1 / height)^2 = 0.7 %.
    EXPECT_LT(worst, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Sides, ParabolaLeaves, testing::Values(0, 1, 2, 5));

// ---- Fluid is drawn out evenly, next to walls too, faster than its viscosity carries
// anything upstream: a cell's Reynolds number of 8.

class Suction : public testing::TestWithParam<Collision> {};

TEST_P(Suction, RunsAndKeepsTheMass) {
    constexpr double speed = 0.08;
    for (const bool closed : {true, false}) {
        FluidConfig config = through_flow({24, 12, 12}, 0.53, 0, speed);
        config.collision = GetParam();
        config.boundaries[1].inlet.velocity_m_s[1] = 0.5 * speed;  // has no meaning there
        if (!closed) config.boundaries[0].kind = BoundaryKind::pressure_outlet;
        config.initial_velocity = [](const Vec3&) { return Vec3{speed, 0, 0}; };
        Fluid fluid(MPI_COMM_WORLD, config);
        const double mass = fluid.totals().mass_kg;
        for (int part = 0; part < 20; ++part) {
            advance(fluid, 100);
            ASSERT_FALSE(on_any_rank(fluid.diverged().has_value()));
            // Rounding of 3456 cells.
            if (closed) {
                EXPECT_NEAR(fluid.totals().mass_kg / mass, 1, 1e-12);
            }
        }
        const double fastest = fluid.totals().max_speed_m_s / speed;
        std::printf("%s: fastest %.2f of the speed\n", closed ? "closed" : "open",
                    fastest);
        // In the middle of a square duct 2.1.
        EXPECT_LT(fastest, 2.5);
    }
}

// Flow that turns round, with an outlet that lets fluid in and out.
TEST_P(Suction, ChangesItsSign) {
    FluidConfig config = channel({16, 8, 8}, 0.53, 0, 0.05, BoundaryKind::no_slip);
    config.collision = GetParam();
    config.boundaries[0].inlet.factor = [](double time_s) {
        return std::sin(2 * std::numbers::pi * time_s / 400);
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int part = 0; part < 20; ++part) {
        advance(fluid, 100);
        ASSERT_FALSE(on_any_rank(fluid.diverged().has_value()));
        EXPECT_LT(fluid.totals().max_speed_m_s, 2.5 * 0.05);
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, Suction, every_collision);

}  // namespace
}  // namespace magfsi::fluid
