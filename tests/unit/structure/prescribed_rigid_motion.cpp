// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid parts that a course moves and turns, whatever acts on them.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "structure/rigid_motion.h"
#include "tests/unit/structure/rigid_bodies.h"

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

// A body of the course, at a time, and its velocities by differences of its places.
RigidMotion at_time(const RigidCourse& course, double time_s) {
    RigidInertia of = brick_inertia();
    of.hold = course;
    RigidMotion body(of);
    body.follow(time_s);
    return body;
}

Formula of_time(const std::string& si) {
    return {si, si};
}

// A turn by a formula about a tilted axis through a point outside: 1.3 rad are made by a
// quarter of the way of a parabola.
TEST(PrescribedMotion, TurnsAboutATiltedAxisToTheClosedForm) {
    const Vec3 axis{1, 2, -2}, about{4e-3, -1e-3, 2e-3};
    const RigidMotion body =
        at_time({{}, TurningMotion{axis, about, of_time("3 + 5.2*t^2")}}, 0.5);
    const Eigen::Quaterniond exact(Eigen::AngleAxisd(1.3, Vector3d(1, 2, -2) / 3));
    EXPECT_LT((body.turn().coeffs() - exact.coeffs()).norm(), 1e-10);
    // 10.4 t; the differences of 10 us are exact for a parabola up to rounding.
    const Vec3 rate = body.angular_velocity_rad_s();
    EXPECT_LT(norm(rate - 5.2 / 3 * axis), 1e-9);
    const Vec3 start = brick_inertia().centre_m;
    const Vector3d arm =
        exact * Vector3d(start[0] - about[0], start[1] - about[1], start[2] - about[2]);
    const Vec3 turned{arm[0], arm[1], arm[2]};
    EXPECT_LT(norm(body.centre_m() - about - turned), 1e-15);
    EXPECT_LT(norm(body.velocity_m_s() - cross(rate, turned)), 1e-15);
    const Vec3 corner{3e-3, 2e-3, 1e-3};
    EXPECT_LT(norm(body.velocity_at(body.place_of(corner)) -
                   cross(rate, body.place_of(corner) - about)),
              1e-15);
}

// A circle of 3 mm, while the body turns at another rate about an axis that the circle
// carries along.
TEST(PrescribedMotion, MovesOnACircleAndTurnsMeanwhile) {
    const RigidCourse course{
        FormulaMotion{
            {of_time("3e-3*cos(20*t)"), of_time("3e-3*sin(20*t)"), of_time("0")}},
        TurningMotion{{0, 0, 2}, {1e-3, 2e-3, 0}, AngleOscillation{0.4, 5, 0}}};
    const double time = 0.13;
    const RigidMotion body = at_time(course, time);
    const double angle = 0.4 * std::sin(2 * pi * 5 * time);
    EXPECT_LT((body.turn().coeffs() -
               Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ())).coeffs())
                  .norm(),
              1e-14);
    const Vec3 shift{3e-3 * (std::cos(20 * time) - 1), 3e-3 * std::sin(20 * time), 0};
    const Vec3 axis{1e-3, 2e-3, 0};
    const Vec3 centre = brick_inertia().centre_m;
    const Vec3 off{centre[0] - axis[0], centre[1] - axis[1], 0};
    const Vec3 turned{std::cos(angle) * off[0] - std::sin(angle) * off[1],
                      std::sin(angle) * off[0] + std::cos(angle) * off[1], centre[2]};
    EXPECT_LT(norm(body.centre_m() - axis - turned - shift), 1e-16);
    // Velocities are the derivatives of the places, to the order of the differences.
    const double h = 1e-5;
    const Vec3 by_places =
        (at_time(course, time + h).centre_m() - at_time(course, time - h).centre_m()) /
        (2 * h);
    EXPECT_LT(norm(body.velocity_m_s() - by_places), 1e-7 * norm(by_places));
}

// Forces, pushes and drag leave it where its course has it.
TEST(PrescribedMotion, TakesNoNoticeOfForces) {
    const RigidCourse course{DisplacementRamp{{1e-3, 0, 0}, 0.1}, {}};
    RigidMotion body = at_time(course, 0.05);
    const auto before = body.state();
    body.set_velocity({1, 1, 1}, {1, 1, 1});
    EXPECT_EQ(body.state(), before);
    EXPECT_NEAR(body.centre_m()[0], brick_inertia().centre_m[0] + 0.5e-3, 1e-16);
    RigidMotion other = at_time(course, 0);
    other.set_state(before);
    EXPECT_EQ(other.state(), before);
    EXPECT_EQ(other.velocity_m_s(), body.velocity_m_s());
    EXPECT_NEAR(body.kinetic_j(), 0.5 * brick_inertia().mass_kg * 1e-6 * pi * pi * 25,
                1e-12 * body.kinetic_j());
}

}  // namespace
}  // namespace magfsi::structure
