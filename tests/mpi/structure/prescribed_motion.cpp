// A face that something outside moves follows its course on any number of ranks, and the
// body follows the face.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "structure/lammps/effects/prescribed_motion/motion_law.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

// Each step adds a displacement's gain: a rounding of 4e-19 m, half of the last digit of
// 4 mm, in each of some thousand steps.
constexpr double rounding_m = 1e-15;

struct Nodes {
    std::vector<double> start, x, v;
};

Nodes moved(const LammpsInput& input, int steps) {
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    Nodes nodes;
    nodes.start = run.gather("x");
    run.command("run " + std::to_string(steps) + " pre no post no");
    nodes.x = run.gather("x");
    nodes.v = run.gather("v");
    return nodes;
}

TEST(PrescribedMotion, MovedFacesFollowTheirCourse) {
    LammpsInput input = test::bare_strip();
    const Oscillation wave{{0.2e-3, 0, -0.1e-3}, 40, -std::numbers::pi / 2};
    const DisplacementRamp ramp{{0, 0.1e-3, 0}, 30e-3};
    input.bodies[0].clamps = {"x_min", "x_max"};
    input.motions = {{0, {"x_min"}, wave}, {0, {"x_max"}, ramp}};
    constexpr int steps = 3000;
    const double time_s = steps * input.time_step_s;
    ASSERT_GT(time_s, 5e-3);
    ASSERT_LT(time_s, ramp.duration_s);
    const Nodes nodes = moved(input, steps);
    const auto check = [&](const char* face, const MotionCourse& course) {
        const Vec3 u = displacement_m(course, time_s);
        const Vec3 speed = velocity_m_s(course, time_s);
        for (const int node : input.bodies[0].mesh.faces.at(face)) {
            for (std::size_t d = 0; d < 3; ++d) {
                const std::size_t q = 3 * static_cast<std::size_t>(node) + d;
                EXPECT_NEAR(nodes.x[q] - nodes.start[q], u[d], rounding_m);
                EXPECT_EQ(nodes.v[q], speed[d]);
            }
        }
    };
    check("x_min", wave);
    check("x_max", ramp);
}

TEST(PrescribedMotion, ABodyComesAlongWithItsFace) {
    LammpsInput input = test::bare_strip();
    input.drag_rate_1_s = 220;
    const DisplacementRamp ramp{{1e-3, 0.2e-3, -0.5e-3}, 20e-3};
    input.bodies[0].clamps = {"x_min"};
    input.motions = {{0, {"x_min"}, ramp}};
    const Nodes nodes = moved(input, 40000);
    // 0.12 s after the ramp's end the lowest mode, 112 rad/s and damped critically, has
    // exp(-13) (1 + 13) = 3e-5 of its swing left, which is below the ramp's length.
    for (std::size_t q = 0; q < nodes.x.size(); ++q)
        EXPECT_NEAR(nodes.x[q] - nodes.start[q], ramp.displacement_m[q % 3], 1e-7);
}

TEST(PrescribedMotion, StartsAtTheFaceAndGoesOnWithoutAJump) {
    const Oscillation wave{{1e-3, 0, 0}, 10, 0.7};
    const DisplacementRamp ramp{{1e-3, 0, 0}, 0.05};
    for (const MotionCourse& course : {MotionCourse(wave), MotionCourse(ramp)}) {
        EXPECT_EQ(displacement_m(course, 0), (Vec3{}));
        for (double t = 0.001; t < 0.1; t += 0.0073) {
            constexpr double step = 1e-6;
            const double slope = (displacement_m(course, t + step)[0] -
                                  displacement_m(course, t - step)[0]) /
                                 (2 * step);
            // Central differences: u''' step^2 / 6 is 4e-8 m/s, rounding of u 1e-13.
            EXPECT_NEAR(velocity_m_s(course, t)[0], slope, 1e-7);
        }
        EXPECT_EQ(displacement_m(motion_from({"ramp", "1", "2", "3", "4"}), 4),
                  (Vec3{1, 2, 3}));
    }
}

}  // namespace
}  // namespace magfsi::structure
