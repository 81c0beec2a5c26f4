// SPDX-License-Identifier: GPL-2.0-or-later
// Flows whose smallest eddies the grid does not hold: the shear layers of Minion and
// Brown (J. Comput. Phys. 138 (1997) 734) at Reynolds number 1e5, and the Taylor-Green
// vortex at 1600 on 32^3 cells. A run stays bounded and loses energy in every interval,
// or it names the cell in which it diverged.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "fluid_lbm/fluid.h"
#include "tests/support/taylor_green_vortex.h"

namespace magfsi::fluid {
namespace {

constexpr double pi = std::numbers::pi;

FluidConfig flow(const std::array<int, 3>& cells, double length, double lattice_speed,
                 double viscosity, Collision collision) {
    FluidConfig config;
    config.cells = cells;
    config.spacing_m = length / cells[0];
    config.time_step_s = lattice_speed * config.spacing_m;  // speeds are of order 1
    config.density_kg_m3 = 1;
    config.viscosity_m2_s = viscosity;
    config.collision = collision;
    return config;
}

FluidConfig shear_layers(Collision collision) {
    FluidConfig config = flow({128, 128, 1}, 1, 0.04, 1e-5, collision);
    config.initial_velocity = [](const Vec3& x) {
        const double u = std::tanh(80 * (x[1] <= 0.5 ? x[1] - 0.25 : 0.75 - x[1]));
        return Vec3{u, 0.05 * std::sin(2 * pi * (x[0] + 0.25)), 0};
    };
    return config;
}

FluidConfig vortex(Collision collision) {
    FluidConfig config = flow({32, 32, 32}, 2 * pi, 0.05, 1.0 / 1600, collision);
    start_as_taylor_green_vortex(config);
    return config;
}

struct Course {
    double energy_left = 1;  // at the end, over that of the start
    double most_gained = 0;  // in one of the intervals, over that of the start
    double most_speed = 0;   // over the largest at the start
    double mass_drift = 0;
    Collision collision{};
    std::optional<Divergence> end;
};

Course run(const FluidConfig& config, double end_s, int intervals) {
    Fluid fluid(MPI_COMM_WORLD, config);
    const Totals start = fluid.totals();
    const int steps = static_cast<int>(std::lround(end_s / config.time_step_s));
    Course course;
    course.collision = choose_collision(config);
    double before = 1;
    for (int i = 0; i < intervals; ++i) {
        for (int step = 0; step < steps / intervals; ++step) {
            fluid.step();
            if ((course.end = fluid.diverged())) return course;
        }
        const Totals now = fluid.totals();
        course.energy_left = now.kinetic_energy_j / start.kinetic_energy_j;
        course.most_gained = std::max(course.most_gained, course.energy_left - before);
        course.most_speed =
            std::max(course.most_speed, now.max_speed_m_s / start.max_speed_m_s);
        course.mass_drift = std::abs(now.mass_kg / start.mass_kg - 1);
        before = course.energy_left;
    }
    return course;
}

void print(const char* flow, const Course& course) {
    std::printf("%s, %s: %s\n", flow, name_of(course.collision).data(),
                course.end ? to_string(*course.end).c_str() : "right");
    if (!course.end)
        std::printf("  energy left %.3f, most gained %.1e, fastest %.2f, mass %.1e\n",
                    course.energy_left, course.most_gained, course.most_speed,
                    course.mass_drift);
}

TEST(Unresolved, ShearLayersAtReynolds100000) {
    const FluidConfig config = shear_layers(Collision::automatic);
    const Course course = run(config, 1.0, 20);
    print("shear layers", course);
    ASSERT_FALSE(course.end);
    // The layers roll up, and between the eddies the fluid is twice as fast: 1.98 times
    // on 512^2 cells, 1.93 times on these.
    EXPECT_NEAR(course.most_speed, 1.98, 0.05 * 1.98);
    EXPECT_GT(course.energy_left, 0.98);  // 0.993 on 512^2 cells
    EXPECT_LT(course.most_gained, 1e-4);  // Sound goes to and fro; seen: 0.
    EXPECT_LT(course.mass_drift, 1e-12);  // rounding
}

TEST(Unresolved, TaylorGreenVortexOn32Cells) {
    const FluidConfig config = vortex(Collision::automatic);
    const Course course = run(config, 20, 20);
    print("Taylor-Green vortex", course);
    ASSERT_FALSE(course.end);
    EXPECT_LT(course.most_gained, 1e-4);
    // The resolved flow has 0.2 left at t = 20 (spectral, 512^3: van Rees et al., J.
    // Comput. Phys. 230 (2011) 2794). Without the small eddies less is lost; seen: 0.26.
    EXPECT_LT(course.energy_left, 0.3);
    EXPECT_LT(course.mass_drift, 1e-12);
}

// These have no cure for a relaxation time so near to 1/2: what they make of the flows is
// right or has a name, and never a number that is not one.
TEST(Unresolved, OtherCollisionsEndRightOrNameTheCell) {
    for (const Collision collision : {Collision::bgk, Collision::trt})
        for (const FluidConfig& config : {shear_layers(collision), vortex(collision)}) {
            const Course course = run(config, 2, 10);
            print("other", course);
            if (course.end) {
                EXPECT_EQ(course.end->cause, DivergenceCause::relaxation_time);
            } else {
                EXPECT_TRUE(std::isfinite(course.energy_left));
                EXPECT_LT(course.energy_left, 1);
            }
        }
}

}  // namespace
}  // namespace magfsi::fluid
