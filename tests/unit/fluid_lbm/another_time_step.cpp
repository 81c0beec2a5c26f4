// A flow that is taken over with another time step is the same flow there: density by the
// pressure, velocity and the viscous stress with their populations.
#include <gtest/gtest.h>

#include <vector>

#include "fluid_lbm/lattice/d3q19.h"
#include "fluid_lbm/lattice/equilibrium.h"
#include "fluid_lbm/sampling/step_change.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {
namespace {

std::vector<double> cell(const LocalFlow& flow, double tau) {
    std::vector<double> f;
    for (int q = 0; q < d3q19::directions; ++q)
        f.push_back(flow_population(q, flow, tau));
    return f;
}

FluidConfig config(double step_s) {
    FluidConfig c;
    c.cells = {4, 4, 4};
    c.spacing_m = 1e-4;
    c.time_step_s = step_s;
    c.density_kg_m3 = 1000;
    c.viscosity_m2_s = 1e-6;
    return c;
}

// A divergence-free gradient: of any other the lattice's trace would be a sound wave.
LocalFlow flow(double step) {
    LocalFlow f;
    f.density_excess = 2e-3 * step * step;
    f.velocity = {0.1 * step, -0.05 * step, 0.02 * step};
    f.gradient = {{{1e-2 * step, 3e-3 * step, 0},
                   {-1e-3 * step, -4e-3 * step, 2e-3 * step},
                   {0, 5e-3 * step, -6e-3 * step}}};
    return f;
}

TEST(AnotherTimeStep, has_the_populations_of_the_same_flow) {
    for (const double ratio : {0.5, 0.25}) {
        const FluidConfig before = config(1e-5), after = config(1e-5 * ratio);
        auto f = cell(flow(1), relaxation_time(before));
        change_step(step_change(after, before.time_step_s), f);
        const auto expected = cell(flow(ratio), relaxation_time(after));
        for (std::size_t q = 0; q < f.size(); ++q)
            EXPECT_NEAR(f[q], expected[q], 1e-16) << q;  // rounding of numbers of 1e-3
    }
}

// In Guo's scheme populations hold the velocity less half a step of the force.
TEST(AnotherTimeStep, keeps_the_velocity_under_a_body_force) {
    FluidConfig before = config(1e-5), after = config(5e-6);
    before.body_force_n_m3 = after.body_force_n_m3 = {3e4, 0, 0};
    const double half = 3e4 / units(before).force_n_m3() / 2;
    LocalFlow raw;
    raw.velocity[0] = 0.1 - half;
    auto f = cell(raw, relaxation_time(before));
    change_step(step_change(after, before.time_step_s), f);
    double momentum = 0;
    for (int q = 0; q < d3q19::directions; ++q)
        momentum += d3q19::c[q][0] * f[static_cast<std::size_t>(q)];
    EXPECT_NEAR(momentum + half / 4, 0.05, 1e-15);
}

}  // namespace
}  // namespace magfsi::fluid
