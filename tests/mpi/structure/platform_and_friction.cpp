// A sheet that lies on a platform.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "structure/lammps/effects/platform/platform_law.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

constexpr double mass_kg = 1860 * 3.7e-3 * 1.5e-3 * 0.185e-3;
constexpr double gravity_m_s2 = 9.81;

// The platform rises by `tilt` towards x; seen from it, gravity is tilted.
LammpsInput lying_strip(double tilt, double friction) {
    LammpsInput input = test::bare_strip();
    input.gravity_m_s2 =
        Vec3{gravity_m_s2 * std::sin(tilt), 0, -gravity_m_s2 * std::cos(tilt)};
    input.platform = Platform{};
    input.platform->friction = friction;
    // About critical for the sheet on the platform's springs (75 krad/s), so that it
    // comes to rest on it within the first milliseconds.
    input.platform->damping_pa_s_m = 2e4;
    const double stiffness = platform_of(input).stiffness_pa_m;
    input.time_step_s = 0.9 * platform_step_limit_s(input.bodies[0], stiffness);
    return input;
}

TEST(Platform, CarriesTheWeightAndGivesWayByLessThanAHundredthOfTheThickness) {
    const test::SharedFolder folder;
    LammpsInput input = lying_strip(0, 0);
    input.drag_rate_1_s = 500;  // takes the energy of bending waves, of 1 krad/s and more
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    run.command("run 10000 pre no post no");
    const double weight = mass_kg * gravity_m_s2;
    const double normal = run.fix_value("platform", 0);
    const double gap = run.fix_value("platform", 3);
    std::printf("sheet on a platform: normal force %.6f of the weight, gap %.3g m\n",
                normal / weight, gap);
    // 30 ms at 250 / s leave e^-8 of the vibrations.
    EXPECT_NEAR(normal / weight, 1, 1e-3);
    EXPECT_NEAR(run.fix_value("platform", 6) / normal, 1, 1e-12);
    EXPECT_LT(gap, 0);
    EXPECT_GT(gap, -0.01 * 0.185e-3);
    // Weight per area over stiffness, k/2 penetration^2: edges, whose areas count their
    // two faces, sink in less than the middle, corners least.
    EXPECT_GT(run.fix_value("platform", 2), 0.25 * weight * -gap);
    EXPECT_LT(run.fix_value("platform", 2), 0.55 * weight * -gap);
}

// Mean way along x in 4000 steps after the sheet has settled, beyond its speed then.
double slid_m(double tilt, double friction, double& time_s) {
    const LammpsInput input = lying_strip(tilt, friction);
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    run.command("run 2000 pre no post no");  // settles
    const auto start = run.gather("x");
    const auto v = run.gather("v");
    run.command("run 4000 pre no post no");
    const auto end = run.gather("x");
    time_s = 4000 * input.time_step_s;
    double moved = 0;
    for (std::size_t q = 0; q < end.size(); q += 3) {
        moved +=
            (end[q] - start[q] - v[q] * time_s) / static_cast<double>(end.size() / 3);
    }
    return moved;
}

TEST(Friction, HoldsBelowItsAngleAndSlidesAboveByCoulombsLaw) {
    constexpr double degree = std::numbers::pi / 180;
    double time = 0;
    const double held = slid_m(20 * degree, 0.5, time);
    const double slid = slid_m(40 * degree, 0.5, time);
    const double expected = 0.5 * time * time * gravity_m_s2 *
                            (std::sin(40 * degree) - 0.5 * std::cos(40 * degree));
    std::printf(
        "friction 0.5, %.3g s: at 20 degrees %.3g m, at 40 degrees %.4g of the "
        "law's %.3g m\n",
        time, held, slid / expected, expected);
    // tan 20 = 0.36 < 0.5: only what is left of the vibration of the springs.
    EXPECT_LT(std::abs(held), 1e-4 * expected);
    // The weight presses the springs by 2 nm only, so that a sliding, vibrating sheet
    // hops: a node's friction is that of the end of the step in which it lands, and the
    // hops are not over when the interval begins.
    EXPECT_NEAR(slid / expected, 1, 0.05);
}

}  // namespace
}  // namespace magfsi::structure
