// SPDX-License-Identifier: GPL-2.0-or-later
// Magnetisation that follows the rotation of the material: derivatives of its energy, and
// a hanging bar that a weight stretches and a field turns, by its closed form.
#include "structure/magnetics/turned_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "structure/equilibrium/newton.h"
#include "tests/unit/structure/derivatives.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const Vec3 field_t{0.02, -0.03, 0.05};

TEST(Turned, RotationIsThatOfThePolarDecomposition) {
    test::Random random(21);
    for (int trial = 0; trial < 50; ++trial) {
        const Eigen::Matrix3d r = random.rotation(), q = random.rotation();
        const Eigen::Vector3d stretch(random.within(0.2, 5), random.within(0.5, 2), 1);
        const Eigen::Matrix3d f = r * q * stretch.asDiagonal() * q.transpose();
        EXPECT_LT((rotation_of(f) - r).norm(), 1e-13);  // rounding
    }
}

TEST(Turned, MomentKeepsItsStrengthAndTurnsWithTheMaterial) {
    const Mesh mesh = box_mesh({{2e-4, 3e-4, 1e-4}, {1, 1, 1}});
    const auto elements = turned_elements(mesh.nodes, mesh.elements, {{0, 62e3, 0}});
    test::Random random(22);
    const Eigen::Matrix3d r = random.rotation();
    const Eigen::Matrix3d f = r * Eigen::Vector3d(0.8, 1.6, 0.9).asDiagonal();
    const Eigen::Vector3d moment =
        turned_moment(elements[0], gather(mesh.nodes, mesh.elements[0]) * f.transpose());
    const Eigen::Vector3d expected = 6e-12 * 62e3 * r.col(1);
    EXPECT_LT((moment - expected).norm(), 1e-13 * expected.norm());
}

// A body in random deformation, magnetised here and there in other directions.
TEST(Turned, ForcesAndTangentAreDerivativesOfTheEnergy) {
    Body body;
    body.name = "block";
    body.mesh = test::distorted_block({{4e-4, 3e-4, 2e-4}, {2, 1, 1}}, 1e-5, 9);
    body.material = test::soft_material();
    body.clamps = {"x_min"};
    body.follows = MagnetizationFollows::rotation;
    body.magnetization_a_m = {{62e3, 10e3, -20e3}, {-30e3, 0, 50e3}};
    StaticProblem problem(body);
    test::Random random(10);
    Eigen::VectorXd x = flat_positions(body.mesh.nodes);
    for (Eigen::Index q = 0; q < x.size(); ++q)
        x[q] = 1.2 * x[q] + 2e-5 * random.uniform();
    NodalLoads loads = problem.load({field_t, {}});
    EXPECT_TRUE(loads.dead_n.isZero(0));
    // The field is strong, so that its terms are no small part of the tangent.
    loads.turning_t *= 100;
    problem.assemble(x, loads);
    const Eigen::MatrixXd tangent = test::whole_tangent(problem);
    // (h/l)^2 = 1e-10 of the tangent and rounding.
    test::expect_derivatives(problem, body, x, loads, tangent,
                             1e-6 * tangent.cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Turned, FieldTurnsABodyAndDoesNotCarryIt) {
    const Mesh mesh = box_mesh({{4e-4, 3e-4, 2e-4}, {2, 2, 1}});
    const std::vector<Vec3> moments(mesh.elements.size(), Vec3{50e3, 0, 20e3});
    const auto elements = turned_elements(mesh.nodes, mesh.elements, moments);
    test::Random random(11);
    std::vector<double> x, f(3 * mesh.nodes.size(), 0.0);
    for (const Vec3& node : mesh.nodes) {
        for (const double c : node) x.push_back(c + 2e-5 * random.uniform());
    }
    const Eigen::Vector3d field(field_t.data());
    const Eigen::Vector3d moment =
        add_turned_forces(elements, mesh.elements, field, x.data(), f.data());
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = force;
    double largest = 0;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const Eigen::Vector3d own(&f[3 * n]), at(&x[3 * n]);
        force += own;
        torque += at.cross(own);
        largest = std::max(largest, own.norm());
    }
    EXPECT_LT(force.norm(), 1e-13 * largest);
    EXPECT_LT((torque - moment.cross(field)).norm(), 1e-12 * torque.norm());
}

// A bar hangs from its upper end, a weight W at the lower one; the field is across. With
// the stretch a of the bar and its inclination p, the couple of a length dS at rest is
// that of the forces at its ends:
//   W a sin p = A |m| B cos p,   |m| = M (rotation) or a M (deformation).
struct Hanging {
    double slope = 0;    // tan p in the middle
    double stretch = 0;  // a
};
Hanging hang(MagnetizationFollows follows) {
    const double side = 0.5e-3, length = 20e-3;
    Body body;
    body.name = "bar";
    body.mesh = box_mesh({{side, side, length + 2e-3}, {1, 1, 44}});
    body.material = {30e3, 6000e3, 1e-3};
    body.other_materials = {{30e6, 60e6, 1.6e6}};
    body.follows = follows;
    body.clamps = {"z_max"};
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const bool weight = element_centre(body.mesh, e)[2] < 2e-3;
        body.element_material.push_back(weight ? 1 : 0);
        body.magnetization_a_m.push_back({0, 0, weight ? 0 : 60e3});
    }
    const Equilibrium found = NewtonSolver(body).solve({{30e-3, 0, 0}, {0, 0, -9.81}});
    const auto at = [&](double z) {
        Vec3 mean{};
        for (std::size_t n = 0; n < body.mesh.nodes.size(); ++n) {
            if (std::abs(body.mesh.nodes[n][2] - z) < 1e-9)
                mean += 0.25 * found.nodes_m[n];
        }
        return mean;
    };
    const Vec3 low = at(8e-3), high = at(16e-3);
    const Vec3 way = high - low;
    return {way[0] / way[2], norm(way) / 8e-3};
}

TEST(Turned, BarStretchedByAWeightTurnsByItsClosedForm) {
    const double weight_n = 1.6e6 * 2e-3 * 0.25e-6 * 9.81;
    const double couple_n = 0.25e-6 * 60e3 * 30e-3;  // A M B
    const Hanging turned = hang(MagnetizationFollows::rotation);
    const Hanging stretched = hang(MagnetizationFollows::deformation);
    std::printf("stretch %.4f: slope %.5f by rotation, %.5f by deformation\n",
                turned.stretch, turned.slope, stretched.slope);
    EXPECT_GT(turned.stretch, 1.4);
    // The weight of the pull along the inclined bar and the bar's bending near its ends
    // are of the square of the slope and of exp(-8).
    EXPECT_NEAR(turned.slope / (couple_n / (weight_n * turned.stretch)), 1, 5e-3);
    EXPECT_NEAR(stretched.slope / (couple_n / weight_n), 1, 5e-3);
}

// A free strip of harmonic magnetisation, bent by a field, turns with it as it is. Its
// tangent is indefinite just after the field has been turned.
TEST(Turned, FreeStripFollowsAFieldThatTurns) {
    Body body;
    body.name = "strip";
    body.mesh = box_mesh({{3.7e-3, 1.5e-3, 0.185e-3}, {12, 4, 1}});
    body.material = {33e3, 660e3, 1860};
    body.follows = MagnetizationFollows::rotation;
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const double angle =
            (2 * element_centre(body.mesh, e)[0] / 3.7e-3 + 0.25) * std::numbers::pi;
        body.magnetization_a_m.push_back(
            {62e3 * std::cos(angle), 0, 62e3 * std::sin(angle)});
    }
    const auto turned_to = [](double degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        return StaticLoads{{16.9e-3 * std::cos(angle), 0, 16.9e-3 * std::sin(angle)}, {}};
    };
    NewtonSolver solver(body);
    const Equilibrium start = solver.release(body.mesh.nodes, turned_to(225));
    const std::vector<StaticLoads> path{turned_to(202.5), turned_to(180)};
    const auto found = solver.follow(start.nodes_m, turned_to(225), path);
    const auto chord = [&](const Equilibrium& at) {
        return at.nodes_m.back() - at.nodes_m.front();
    };
    const Vec3 before = chord(start), after = chord(found.back());
    const double turn = std::atan2(after[2], after[0]) - std::atan2(before[2], before[0]);
    std::printf("turned by %.6f degrees in %d and %d iterations\n",
                turn * 180 / std::numbers::pi, found[0].iterations, found[1].iterations);
    EXPECT_NEAR(std::remainder(turn + std::numbers::pi / 4, 2 * std::numbers::pi), 0,
                1e-5);  // of its tolerance
    for (const Equilibrium& one : found) {
        EXPECT_EQ(one.releases, 0);
        EXPECT_LT(one.iterations, 30);
    }
}

}  // namespace
}  // namespace magfsi::structure
