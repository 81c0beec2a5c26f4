// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid parts: mass and inertia of the meshed solid, and the laws of their motion.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>

#include "structure/lattice/inertia.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/rigid_mass.h"
#include "structure/lattice/stable_step.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/round_mesh.h"
#include "structure/rigid_motion.h"
#include "tests/support/checks.h"
#include "tests/unit/structure/elements.h"
#include "tests/unit/structure/rigid_bodies.h"

namespace magfsi::structure {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

Matrix3d turned(const Matrix3d& inertia, const Matrix3d& by) {
    return by * inertia * by.transpose();
}

// --- mass and inertia

TEST(RigidMass, OfABoxOfOneElementIsThatOfTheSolid) {
    const Vec3 size{3e-3, 2e-3, 1e-3};
    const Body body = rigid(box_mesh({size, {1, 1, 1}}));
    const RigidMass found = rigid_mass(body, 0, body.mesh.nodes);
    const double mass = 1200 * size[0] * size[1] * size[2];
    EXPECT_NEAR(found.mass_kg / mass, 1, 1e-14);
    for (int d = 0; d < 3; ++d) {
        const double a = size[(d + 1) % 3], b = size[(d + 2) % 3];
        EXPECT_NEAR(found.inertia_kg_m2(d, d) / (mass * (a * a + b * b) / 12), 1, 1e-13);
        EXPECT_NEAR(found.centre_m[d], size[d] / 2, 1e-17);
    }
    EXPECT_LT(std::abs(found.inertia_kg_m2(0, 1)), 1e-13 * found.inertia_kg_m2(0, 0));
    // Masses at the nodes would have three times the moments.
    const Matrix3d beyond = inertia_beyond_nodes_kg_m2(body, 0, body.mesh.nodes);
    EXPECT_NEAR(beyond(2, 2) / found.inertia_kg_m2(2, 2), -2, 1e-12);
}

// The integrals are exact for elements of any shape: one skewed element, cut into 216,
// has the same.
TEST(RigidMass, OfASkewedElementIsExact) {
    const auto skewed = [](int n) {
        Mesh mesh = box_mesh({{1, 1, 1}, {n, n, n}});
        for (Vec3& x : mesh.nodes) {
            const auto [u, v, w] = x;
            x = {u + 0.2 * v * w + 0.1 * u * v * w, v - 0.3 * u * w, w + 0.25 * u * v};
        }
        return rigid(mesh);
    };
    const RigidMass one = rigid_mass(skewed(1), 0, skewed(1).mesh.nodes);
    const RigidMass many = rigid_mass(skewed(6), 0, skewed(6).mesh.nodes);
    EXPECT_NEAR(one.mass_kg / many.mass_kg, 1, 1e-13);
    EXPECT_LT((one.inertia_kg_m2 - many.inertia_kg_m2).norm(),
              1e-12 * one.inertia_kg_m2.norm());
}

// 2/5 m r^2 within the error of the mesh, whose volume is that of the ball. Its surface
// is off by d ~ h^2, and the mean of d is 0, so that the error of the inertia is that of
// d^2.
TEST(RigidMass, OfABallIsThatOfTheBallToFourthOrder) {
    const auto error = [](int n) {
        const Body body = rigid(ball_mesh({2e-3, {2 * n, n}}));
        const RigidMass found = rigid_mass(body, 0, body.mesh.nodes);
        const double mass = 1200 * 4.0 / 3 * pi * 1e-9;
        EXPECT_NEAR(found.mass_kg / mass, 1, 1e-12);
        EXPECT_LT(norm(found.centre_m), 1e-16);
        return found.inertia_kg_m2.trace() / 3 / (0.4 * mass * 1e-6) - 1;
    };
    const double coarse = error(1), fine = error(2), finest = error(4);
    EXPECT_LT(std::abs(coarse), 0.05);
    EXPECT_NEAR(std::log2(coarse / fine), 4, 0.4);
    EXPECT_NEAR(std::log2(fine / finest), 4, 0.2);
}

// Half a bar is rigid. The elements beside it lend it the masses at the common nodes: the
// sum of the masses is that of the bar.
TEST(RigidMass, TakesTheSharesOfSoftNeighbours) {
    Body body = rigid(box_mesh({{4e-3, 1e-3, 1e-3}, {4, 1, 1}}));
    body.material = {1e6, 1e6, 1200};
    body.element_rigid = {-1, -1, 0, 0};
    const RigidMass found = rigid_mass(body, 0, body.mesh.nodes);
    const double element = 1200e-9;
    EXPECT_NEAR(found.mass_kg / (2.5 * element), 1, 1e-13);
    EXPECT_NEAR(found.centre_m[0], (2 * 3e-3 + 0.5 * 2e-3) / 2.5, 1e-16);
    double soft = 0;
    const auto part = rigid_part_of_nodes(body);
    const auto mass = build_lattice(body).node_mass_kg;
    for (std::size_t n = 0; n < mass.size(); ++n)
        if (part[n] < 0) soft += mass[n];
    EXPECT_NEAR((soft + found.mass_kg) / (4 * element), 1, 1e-13);
}

TEST(RigidMass, TurnsAndMovesWithTheNodes) {
    const Body body = rigid(box_mesh({{3e-3, 2e-3, 1e-3}, {2, 2, 1}}));
    const RigidMass before = rigid_mass(body, 0, body.mesh.nodes);
    test::Random random(3);
    const Matrix3d turn = random.rotation();
    std::vector<Vec3> moved;
    for (const Vec3& x : body.mesh.nodes) {
        const Vector3d y = turn * Vector3d(x[0], x[1], x[2]);
        moved.push_back({y[0] + 5, y[1] - 3, y[2] + 1});
    }
    const RigidMass after = rigid_mass(body, 0, moved);
    EXPECT_LT((after.inertia_kg_m2 - turned(before.inertia_kg_m2, turn)).norm(),
              1e-11 * before.inertia_kg_m2.norm());
}

TEST(RigidParts, AreRefusedWhereTheyTouchOrAreInPieces) {
    Body body = rigid(box_mesh({{4e-3, 1e-3, 1e-3}, {4, 1, 1}}));
    body.rigid_parts = {{"left", {}}, {"right", {}}};
    body.element_rigid = {0, 0, 1, 1};
    EXPECT_NE(test::message_of([&] { (void)rigid_part_of_nodes(body); }).find("touch"),
              std::string::npos);
    body.element_rigid = {0, -1, -1, 1};
    EXPECT_NO_THROW((void)rigid_part_of_nodes(body));
    body.rigid_parts.resize(1);
    body.element_rigid = {0, -1, -1, 0};
    EXPECT_NE(test::message_of([&] { (void)rigid_part_of_nodes(body); }).find("pieces"),
              std::string::npos);
}

TEST(RigidParts, SetNoStepOfTheirOwn) {
    Body body = rigid(box_mesh({{4e-3, 1e-3, 1e-3}, {4, 1, 1}}));
    EXPECT_TRUE(std::isinf(stable_step_s(body)));
    Body soft = body;
    soft.rigid_parts.clear();
    soft.element_rigid.clear();
    soft.material = {1e6, 1e6, 1200};
    // A tip a million times stiffer does not count where it is rigid.
    body.material = {1e12, 1e12, 1200};
    body.other_materials = {soft.material};
    body.element_material = {1, 1, 1, 0};
    body.element_rigid = {-1, -1, -1, 0};
    EXPECT_DOUBLE_EQ(stable_step_s(body), stable_step_s(soft));
    // Springs on a rigid part alone: the plane of a box on springs k at its nodes.
    Body box = rigid(box_mesh({{1e-3, 1e-3, 1e-3}, {1, 1, 1}}));
    const double k = 3;
    const double rocking = 8 * k * 0.5e-6 / (1200e-9 * 1e-6 / 6);
    EXPECT_NEAR(rate_on_part(box, 0, std::vector<double>(8, k)) / rocking, 1, 1e-12);
}

// --- motion

// Steps of a body under a torque (and a force) that depend on its motion.
using Load = std::function<void(RigidMotion&)>;
void advance(RigidMotion& body, double step_s, int steps, const Load& load = {}) {
    for (int i = 0; i < steps; ++i) {
        body.push(0.5 * step_s);
        body.drift(step_s);
        if (load) load(body);
        body.push(0.5 * step_s);
    }
}

// Dzhanibekov's flips: a brick spun about its middle axis, 100 turns in 200 steps each.
TEST(RigidMotion, OfAnAsymmetricBodyKeepsEnergyAndMomentumOver100Turns) {
    RigidMotion body(brick_inertia());
    const double rate = 2 * pi * 10;
    body.set_velocity({0.1, 0, 0}, {1e-3 * rate, rate, 1e-3 * rate});
    const double energy = body.kinetic_j();
    const Vec3 momentum = body.angular_momentum_kg_m2_s();
    double energy_error = 0, momentum_error = 0, lowest = 1;
    for (int turn = 0; turn < 100; ++turn) {
        advance(body, 1.0 / 10 / 200, 200);
        energy_error = std::max(energy_error, std::abs(body.kinetic_j() / energy - 1));
        // From the nodes' velocities, not from the state that is kept.
        const Matrix3d now =
            turned(brick_inertia().inertia_kg_m2, body.turn().toRotationMatrix());
        const Vec3 w = body.angular_velocity_rad_s();
        const Vector3d l = now * Vector3d(w[0], w[1], w[2]);
        momentum_error = std::max(
            momentum_error, norm(Vec3{l[0], l[1], l[2]} - momentum) / norm(momentum));
        lowest = std::min(lowest, body.turn().toRotationMatrix()(1, 1));
    }
    EXPECT_LT(lowest, -0.9);  // it has flipped
    EXPECT_LT(energy_error, 1e-8);
    EXPECT_LT(momentum_error, 1e-11);
    EXPECT_NEAR(body.centre_m()[0], brick_inertia().centre_m[0] + 0.1 * 10, 1e-12);
}

TEST(RigidMotion, IsOfFourthOrderWithoutATorque) {
    const auto turn_after = [](int steps) {
        RigidMotion body(brick_inertia());
        body.set_velocity({}, {3, 5, -2});
        advance(body, 1.0 / steps, steps);
        return body.turn();
    };
    const auto exact = turn_after(4000);
    const double coarse = exact.angularDistance(turn_after(100));
    const double fine = exact.angularDistance(turn_after(200));
    EXPECT_NEAR(std::log2(coarse / fine), 4, 0.2);
}

TEST(RigidMotion, RunsBackwardsToItsStart) {
    RigidMotion body(brick_inertia());
    body.set_velocity({0.1, 0.2, 0}, {30, 50, -20});
    const auto start = body.state();
    advance(body, 1e-3, 1000);
    advance(body, -1e-3, 1000);
    const auto end = body.state();
    for (std::size_t i = 0; i < start.size(); ++i)
        EXPECT_NEAR(end[i], start[i], 1e-11 * (1 + std::abs(start[i])));
}

// A disc of radius r on a rod without mass, held at the rod's foot, tilted by 30 degrees
// and spun so that it precesses steadily: I1 cos(a) W^2 - I3 s W + M g l = 0, with s the
// spin about its own axis (Goldstein, sec. 5.7).
TEST(RigidMotion, OfAHeavyTopPrecessesAsTheClosedFormSays) {
    const double mass = 0.01, r = 0.02, arm = 0.03, g = 9.81, tilt = pi / 6;
    const double i3 = 0.5 * mass * r * r, i1 = 0.25 * mass * r * r + mass * arm * arm;
    const double precession = 9, c = std::cos(tilt);
    const double spin =
        (i1 * c * precession * precession + mass * g * arm) / (i3 * precession);
    const Vector3d axis(std::sin(tilt), 0, c);
    Matrix3d inertia = 0.25 * mass * r * r * Matrix3d::Identity();
    inertia += (i3 - 0.25 * mass * r * r) * axis * axis.transpose();
    const Vector3d centre = arm * axis;
    RigidMotion top({mass, {centre[0], centre[1], centre[2]}, inertia, Pivot{}});
    const Vector3d rate = precession * Vector3d::UnitZ() + (spin - precession * c) * axis;
    top.set_velocity({}, {rate[0], rate[1], rate[2]});
    const Load weight = [&](RigidMotion& body) {
        const Vec3 force{0, 0, -mass * g};
        body.set_load(force, cross(body.centre_m() - body.reference_m(), force));
    };
    weight(top);
    const double step = 0.01 / spin;
    const int steps = static_cast<int>(std::lround(3 * 2 * pi / precession / step));
    advance(top, step, steps, weight);
    const Vec3 at = top.centre_m();
    const double turned_by = std::atan2(at[1], at[0]);
    const double expected = std::remainder(precession * step * steps, 2 * pi);
    // Three turns of precession, 6 pi rad.
    EXPECT_NEAR(std::remainder(turned_by - expected, 2 * pi) / (6 * pi), 0, 1e-4);
    EXPECT_NEAR(at[2] / (arm * c), 1, 1e-4);  // it does not nod
}

// A needle of moment m in a field B swings at sqrt(m B / I); at 1 degree slower by
// theta^2 / 16.
TEST(RigidMotion, OfACompassNeedleHasTheFrequencyOfTheClosedForm) {
    const RigidInertia needle = brick_inertia();
    const double about = needle.inertia_kg_m2(1, 1), stiffness = 4e-9;
    const double theta = 1 * pi / 180;
    const double rate = std::sqrt(stiffness / about) * (1 - theta * theta / 16);
    for (const bool hinged : {false, true}) {
        RigidInertia of = needle;
        if (hinged) of.hold = Hinge{{0, 2, 0}, of.centre_m};
        RigidMotion body(of);
        const Load torque = [&](RigidMotion& now) {
            const Vector3d moment =
                now.turn() * Vector3d(std::cos(theta), 0, std::sin(theta));
            now.set_load(
                {}, stiffness * cross({moment[0], moment[1], moment[2]}, Vec3{1, 0, 0}));
        };
        torque(body);
        const double step = 0.01 / rate;
        const auto tilt = [&] {
            const Vector3d moment =
                body.turn() * Vector3d(std::cos(theta), 0, std::sin(theta));
            return std::atan2(moment[2], moment[0]);
        };
        double before = tilt(), first = -1, last = 0;
        int crossings = 0;
        for (int i = 1; i < 6000; ++i) {
            advance(body, step, 1, torque);
            const double now = tilt();
            if (before * now < 0) {
                last = step * (i - now / (now - before));
                if (first < 0) first = last;
                ++crossings;
            }
            before = now;
        }
        const double found = pi * (crossings - 1) / (last - first);
        EXPECT_NEAR(found / rate, 1, 1e-5) << hinged;
    }
}

// About an axis that is not a principal one and not through the centre the body swings as
// a pendulum of its inertia there.
TEST(RigidMotion, OnAHingeIsAPhysicalPendulum) {
    RigidInertia of = brick_inertia();
    const Vec3 about{of.centre_m[0], of.centre_m[1], of.centre_m[2] + 4e-3};
    const Vector3d axis = Vector3d(1, 1, 0).normalized();
    of.hold = Hinge{{1, 1, 0}, about};
    RigidMotion body(of);
    const double g = 9.81;
    const double inertia = axis.dot(of.inertia_kg_m2 * axis) + of.mass_kg * 16e-6;
    body.set_velocity({}, {0.07, 0.07, 0});
    const Load weight = [&](RigidMotion& now) {
        const Vec3 force{0, 0, -of.mass_kg * g};
        now.set_load(force, cross(now.centre_m() - now.reference_m(), force));
    };
    weight(body);
    const double energy = body.kinetic_j() + of.mass_kg * g * body.centre_m()[2];
    const double rate = std::sqrt(of.mass_kg * g * 4e-3 / inertia);
    const double step = 0.005 / rate;
    advance(body, step, static_cast<int>(std::lround(2 * pi / rate / step)), weight);
    EXPECT_NEAR(body.angular_velocity_rad_s()[0], 0.07, 0.07 * 1e-3);
    EXPECT_NEAR((body.kinetic_j() + of.mass_kg * g * body.centre_m()[2]) / energy, 1,
                1e-9);
    EXPECT_LT(std::abs(body.velocity_m_s()[0] + body.velocity_m_s()[1]), 1e-12);
}

TEST(RigidMotion, GoesOnFromItsStateToTheBit) {
    RigidMotion body(brick_inertia());
    body.set_velocity({0.1, 0.2, 0}, {30, 50, -20});
    advance(body, 1e-3, 17);
    RigidMotion other(brick_inertia());
    other.set_state(body.state());
    advance(body, 1e-3, 23);
    advance(other, 1e-3, 23);
    EXPECT_EQ(body.state(), other.state());
}

TEST(RigidMotion, RefusesASingleNodeAndALine) {
    EXPECT_NE(test::message_of([] {
                  RigidMotion({1, {}, Matrix3d::Zero(), {}});
              }).find("moments of inertia"),
              std::string::npos);
    const Matrix3d line = Vector3d(0, 1, 1).asDiagonal();
    EXPECT_FALSE(test::message_of([&] { RigidMotion({1, {}, line, {}}); }).empty());
    EXPECT_FALSE(test::message_of([] {
                     RigidMotion({0, {}, Matrix3d::Identity(), {}});
                 }).empty());
}

}  // namespace
}  // namespace magfsi::structure
