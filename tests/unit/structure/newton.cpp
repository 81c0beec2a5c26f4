// SPDX-License-Identifier: GPL-2.0-or-later
// Equilibria of beams and strips: loads, paths, stability, and what is refused.
#include "structure/equilibrium/newton.h"
#include <gtest/gtest.h>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include "structure/body.h"
#include "structure/magnetics/magnetization.h"
#include "tests/support/checks.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

Body beam(const Box& box, double magnetization_a_m) {
    Body body;
    body.name = "beam";
    body.mesh = box_mesh(box);
    body.material = {330e3, 6600e3, 1000};
    body.element = ElementVariant::assumed_strain;
    body.clamps = {"x_min"};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {magnetization_a_m, 0, 0});
    return body;
}

Body cantilever() {
    return beam({{20e-3, 1e-3, 1e-3}, {20, 1, 1}}, 33e3);
}

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double largest = 0;
    for (std::size_t n = 0; n < a.size(); ++n) {
        for (int d = 0; d < 3; ++d) {
            largest = std::max(largest, std::abs(a[n][d] - b[n][d]));
        }
    }
    return largest;
}

TEST(Newton, SagsUnderItsWeightAsEulerAndBernoulliSay) {
    const Body body = cantilever();
    const double gravity = 0.02;
    const Equilibrium found = NewtonSolver(body).solve({{}, {0, 0, -gravity}});
    const int tip = body.mesh.faces.at("x_max").front();
    const double sag = body.mesh.nodes[tip][2] - found.nodes_m[tip][2];
    // rho g A L^4 / (8 E I), E = 62/21 G.
    const double expected =
        1000 * gravity * std::pow(20e-3, 4) * 12 / (8 * 62.0 / 21 * 330e3 * 1e-6);
    std::printf("sag %.4g m, expected %.4g m\n", sag, expected);
    // Clamp and shear, H/L = 5 %.
    EXPECT_NEAR(sag / expected, 1, 0.05);
    // Linear: half the work of the weight is stored.
    EXPECT_NEAR(found.energy_elastic_j / found.energy_weight_j, -0.5, 1e-3);
}

TEST(Newton, FollowsAPathAsItSolvesEachPoint) {
    const Body body = cantilever();
    NewtonSolver solver(body);
    std::vector<StaticLoads> path;
    for (double field : {0.005, 0.02, 0.08}) path.push_back({{0, 0, field}, {}});
    const auto followed = solver.follow(body.mesh.nodes, {}, path);
    for (std::size_t i = 0; i < path.size(); ++i) {
        const Equilibrium alone = solver.solve(path[i]);
        // A residual of 1e-9 of the load, times the beam's softness of 1e3.
        EXPECT_LT(distance(alone.nodes_m, followed[i].nodes_m), 1e-6 * 20e-3);
    }
}

// The mixed iteration and the descent of the energy come to one equilibrium. Nothing
// turns the strip out of its plane of symmetry, so that the turn about the field, which
// costs no energy, needs no care.
void expect_one_shape(const Body& body, const StaticLoads& loads, double length_m) {
    NewtonSolver solver(body);
    const Equilibrium stepped = solver.solve(loads);
    const Equilibrium released = solver.release(body.mesh.nodes, loads);
    const double apart = distance(stepped.nodes_m, released.nodes_m) / length_m;
    std::printf("%s: %.2e L apart, %d and %d iterations\n", body.name.c_str(), apart,
                stepped.iterations, released.iterations);
    // A residual of 1e-9 of the load, times a softness of (L/h)^2 = 300 to 400.
    EXPECT_LT(apart, 1e-6);
    for (const Equilibrium& found : {stepped, released}) {
        EXPECT_LT(found.residual, 1e-9);
        EXPECT_EQ(found.negative_eigenvalues, 0);
        for (const std::string& face : body.clamps) {
            for (int node : body.mesh.faces.at(face)) {
                EXPECT_EQ(found.nodes_m[node], body.mesh.nodes[node]);
            }
        }
    }
}

TEST(Newton, FindsTheShapeOfTheReleasedBeam) {
    Body body = beam({{17.5e-3, 5e-3, 1e-3}, {18, 4, 2}}, 330e3);
    for (ElementVariant variant : test::all_variants) {
        body.element = variant;
        expect_one_shape(body, {{0, 0, 0.002}, {}}, 17.5e-3);
    }
}

TEST(Newton, FindsTheShapesOfTheReleasedStripVAndC) {
    Body body;
    body.name = "strip";
    body.mesh = box_mesh({{3.7e-3, 1.5e-3, 0.185e-3}, {20, 4, 2}});
    body.material = test::soft_material();
    body.element = ElementVariant::assumed_strain;
    body.magnetization_a_m =
        harmonic_magnetization(body.mesh, {62e3, 3.7e-3, std::numbers::pi / 4, 0, 2});
    for (double degrees : {45.0, 225.0}) {
        const double angle = degrees * std::numbers::pi / 180;
        expect_one_shape(body, {{5e-3 * std::cos(angle), 0, 5e-3 * std::sin(angle)}, {}},
                         3.7e-3);
    }
}

TEST(Newton, LeavesABodyWithoutLoadsAtRest) {
    Body body = cantilever();
    body.clamps.clear();
    const Equilibrium found = NewtonSolver(body).solve({});
    EXPECT_EQ(found.nodes_m, body.mesh.nodes);
    EXPECT_EQ(found.iterations, 0);
    EXPECT_EQ(found.negative_eigenvalues, 0);
}

// A free magnet that lies across the field turns along it, wherever its turn starts.
TEST(Newton, TurnsAFreeMagnetAlongTheField) {
    Body body = cantilever();
    body.clamps.clear();
    const Equilibrium found = NewtonSolver(body).solve({{0, 0, 1e-3}, {}});
    const auto& line = body.mesh.centre_line;
    Vec3 ends{};
    for (int a = 0; a < 8; ++a) {
        ends += line.back().weight[a] * found.nodes_m[line.back().node[a]] -
                line.front().weight[a] * found.nodes_m[line.front().node[a]];
    }
    // Residual 1e-9 over the torque's own stiffness, which the same field makes.
    EXPECT_NEAR(ends[0] / 20e-3, 0, 1e-6);
    EXPECT_GT(ends[2], 19.9e-3);
    EXPECT_EQ(found.negative_eigenvalues, 0);
}

// A beam magnetised along itself buckles in a field against it, above the rod load
// lambda = 12 gamma (L/H)^2 G/E = pi^2/4 (elastica at 180 degrees).
constexpr double slenderness = 30;

// Wider than thick, so that one way to buckle comes first.
Body slender_beam() {
    const double height = 30e-3 / slenderness;
    return beam({{30e-3, 2 * height, height}, {30, 2, 1}}, 330e3);
}

// Field in units of the buckling load of the rod.
StaticLoads against(double share) {
    const double critical = std::pow(std::numbers::pi, 2) / 4 * (62.0 / 21) /
                            (12 * slenderness * slenderness);
    return {{-share * critical, 0, 0}, {}};
}

double tip_rise(const Body& body, const Equilibrium& found) {
    const int tip = body.mesh.faces.at("x_max").front();
    return found.nodes_m[tip][2] - body.mesh.nodes[tip][2];
}

TEST(Newton, ReportsTheBuckledBeamAsUnstable) {
    const Body body = slender_beam();
    NewtonSolver solver(body);
    // Clamp, shear and the width move the critical load of the solid from that of the rod
    // by about H/L = 3 %.
    const Equilibrium below = solver.solve(against(0.93));
    const Equilibrium above = solver.solve(against(1.07));
    EXPECT_EQ(below.negative_eigenvalues, 0);
    EXPECT_EQ(above.negative_eigenvalues, 1);
    // Straight: the load has no part across the beam. Near the critical load the residual
    // of 1e-9 is all that keeps the tip from wandering.
    EXPECT_NEAR(tip_rise(body, above) / 30e-3, 0, 1e-4);
}

TEST(Newton, LeavesTheUnstableBranchOnRequest) {
    const Body body = slender_beam();
    EquilibriumOptions options;
    options.leave_unstable = true;
    NewtonSolver wandering(body, options);
    const Equilibrium bent = wandering.solve(against(1.5));
    const Equilibrium straight = NewtonSolver(body).solve(against(1.5));
    std::printf("straight %.6g J, bent %.6g J, tip %.3g L, %d iterations\n",
                straight.energy_elastic_j + straight.energy_magnetic_j,
                bent.energy_elastic_j + bent.energy_magnetic_j,
                tip_rise(body, bent) / 30e-3, bent.iterations);
    EXPECT_EQ(straight.negative_eigenvalues, 1);
    EXPECT_EQ(bent.negative_eigenvalues, 0);
    EXPECT_GE(bent.releases, 1);
    EXPECT_LT(bent.residual, 1e-9);
    EXPECT_LT(bent.energy_elastic_j + bent.energy_magnetic_j,
              straight.energy_elastic_j + straight.energy_magnetic_j);
    // At 1.5 times the critical load the elastica's tip is about 0.7 L off its line.
    EXPECT_GT(std::abs(tip_rise(body, bent)), 0.3 * 30e-3);
}

// Sideways, of a beam that a field bends on edge: symmetry keeps it on the branch that
// has become unstable, where no step can be followed.
TEST(Newton, GoesOnAlongTheBuckledBranch) {
    const Body body = beam({{18e-3, 5e-3, 1e-3}, {18, 5, 1}}, 100e3);
    EquilibriumOptions options;
    options.leave_unstable = true;
    const std::vector<StaticLoads> path{
        {{0, 10e-3, 0}, {}}, {{0, 20e-3, 0}, {}}, {{0, 40e-3, 0}, {}}};
    NewtonSolver solver(body, options);
    const auto found = solver.follow(body.mesh.nodes, {}, path);
    int iterations = 0;
    for (const Equilibrium& at : found) {
        iterations += at.iterations;
        EXPECT_EQ(at.negative_eigenvalues, 0);
    }
    std::printf("sideways by %.3g and %.3g L in %d iterations\n",
                tip_rise(body, found[1]) / 18e-3, tip_rise(body, found[2]) / 18e-3,
                iterations);
    EXPECT_NEAR(tip_rise(body, found[0]) / 18e-3, 0, 1e-4);
    EXPECT_GT(std::abs(tip_rise(body, found[2])), 0.1 * 18e-3);
    // Pushed off once; again and again at every smallest step it took five times as many.
    EXPECT_EQ(found[2].releases, 0);
    EXPECT_LT(iterations, 250);
}

TEST(Newton, RefusesWhatHasNoEquilibrium) {
    Body body = cantilever();
    test::expect_refusal<std::exception>(
        [&] { NewtonSolver(body).follow({}, {}, {}); },
        {"body beam: 0 start positions found for 84 nodes"});
    body.clamps = {"left"};
    test::expect_refusal<std::exception>(
        [&] { NewtonSolver{body}; },
        {"body beam is clamped at left, but its faces are x_max, x_min,"});
    body.clamps.clear();
    test::expect_refusal<std::exception>(
        [&] {
            NewtonSolver(body).solve({{}, {0, 0, -9.81}});
        },
        {"body beam has weight but no clamp"});
}

TEST(Newton, NamesTheBodyTheLoadAndThePlaceWhereItFails) {
    Body body = cantilever();
    test::expect_refusal<std::exception>(
        [&] {
            NewtonSolver(body).solve({{0, 0, 1e4}, {}});
        },
        {"body beam: no equilibrium at"});
}

// Faces on rollers keep one coordinate: plane strain, and planes of symmetry.
constexpr double g = 0.5e6, lambda = 2e6, density = 1000, length = 0.1;

// Hangs from x_min, free to contract along y and, unless plane, along z.
Body bar(bool plane) {
    Body body;
    body.name = "bar";
    body.mesh = box_mesh({{length, 0.02, 0.03}, {8, 2, 2}});
    body.material = {g, lambda, density};
    body.element = ElementVariant::assumed_strain;
    body.rollers = {{{"x_min"}, 0}, {{"y_min"}, 1}, {{"z_min"}, 2}};
    if (plane) body.rollers.push_back({{"z_max"}, 2});
    return body;
}

// rho a L^2 / (2 E), E the stiffness of the bar along x.
double elongation(const Body& body, double acceleration) {
    const Equilibrium found = NewtonSolver(body).solve({{}, {acceleration, 0, 0}});
    double sum = 0;
    const auto& end = body.mesh.faces.at("x_max");
    for (const int node : end) sum += found.nodes_m[node][0] - length;
    for (std::size_t n = 0; n < found.nodes_m.size(); ++n) {
        const auto held = held_axes(body)[n];
        for (int d = 0; d < 3; ++d)
            EXPECT_TRUE(!held[d] || found.nodes_m[n][d] == body.mesh.nodes[n][d]);
    }
    return sum / static_cast<double>(end.size());
}

TEST(Rollers, MakePlaneStrainAsStiffAsTheoryHasIt) {
    constexpr double acceleration = 0.1;  // strains of 1e-5: linear
    const double young = g * (3 * lambda + 2 * g) / (lambda + g);
    const double poisson = lambda / (2 * (lambda + g));
    const double expected = density * acceleration * length * length / (2 * young);
    // The stress varies linearly along the bar; elements hold it constant, and those at
    // the ends carry the contraction of a neighbour.
    EXPECT_NEAR(elongation(bar(false), acceleration) / expected, 1, 5e-3);
    EXPECT_NEAR(elongation(bar(true), acceleration) / expected, 1 - poisson * poisson,
                5e-3);
}

TEST(Rollers, CarryWeightOnlyAlongTheAxesThatTheyHold) {
    Body body = bar(true);
    body.rollers.erase(body.rollers.begin());
    EXPECT_NO_THROW(NewtonSolver(body).solve({{}, {0, 0.1, 0}}));
    EXPECT_THROW(NewtonSolver(body).solve({{}, {0.1, 0, 0}}), std::invalid_argument);
}

TEST(Rollers, NameTheFaceThatIsNotThere) {
    Body body = bar(true);
    body.rollers = {{{"lid"}, 2}};
    test::expect_refusal<std::invalid_argument>([&] { held_axes(body); },
                                                {"on rollers at lid,"});
}

// Statics of a bar of two materials: springs in series, and two ways to one shape.
double young_pa(const Material& m) {
    return m.shear_modulus_pa * (3 * m.lame_lambda_pa + 2 * m.shear_modulus_pa) /
           (m.lame_lambda_pa + m.shear_modulus_pa);
}

// Mean x displacement of the nodes of a cross-section.
double moved_m(const Body& body, const std::vector<Vec3>& nodes_m, double at_m) {
    double sum = 0;
    int count = 0;
    for (std::size_t n = 0; n < nodes_m.size(); ++n) {
        if (std::abs(body.mesh.nodes[n][0] - at_m) > 1e-9) continue;
        sum += nodes_m[n][0] - body.mesh.nodes[n][0];
        ++count;
    }
    return sum / count;
}

// M along x pulls at the ends, where the charges are, with the stress M B. With next to
// no Poisson's ratio (K = G / 1000) neither the clamp nor the joint holds the sides back,
// and each half has one strain.
TEST(TwoMaterialBar, StretchesAsSpringsInSeries) {
    for (ElementVariant variant : test::all_variants) {
        Body body = test::soft_and_stiff_bar(variant);
        for (Material* m : {&body.material, &body.other_materials[0]}) {
            m->lame_lambda_pa = 1e-3 * m->shear_modulus_pa;
        }
        body.clamps = {"x_min"};
        body.magnetization_a_m = uniform_magnetization(body.mesh, {100e3, 0, 0});
        const double stress_pa = 100e3 * 1e-4;
        const auto nodes = NewtonSolver(body).solve({{1e-4, 0, 0}, {}}).nodes_m;
        const double half_m = 4e-3;
        const double soft_m = half_m * stress_pa / young_pa(body.material);
        const double stiff_m = half_m * stress_pa / young_pa(body.other_materials[0]);
        const double joint = moved_m(body, nodes, half_m) / soft_m;
        const double tip = moved_m(body, nodes, 2 * half_m) / (soft_m + stiff_m);
        std::printf("joint %.6f, tip %.6f of springs in series\n", joint, tip);
        // Half the strain of 1.5e-4 for the nonlinear law, and the Poisson's ratio of
        // 5e-4 squared.
        EXPECT_NEAR(joint, 1, 1e-4);
        EXPECT_NEAR(tip, 1, 1e-4);
    }
}

TEST(TwoMaterialBeam, BendsAlikeStepByStepAndReleased) {
    for (ElementVariant variant : test::all_variants) {
        Body body = test::soft_and_stiff_bar(variant);
        body.clamps = {"x_min"};
        body.magnetization_a_m = uniform_magnetization(body.mesh, {33e3, 0, 0});
        const StaticLoads loads{{0, 0, 2e-3}, {}};
        NewtonSolver solver(body);
        const Equilibrium stepped = solver.solve(loads);
        const auto released = solver.release(body.mesh.nodes, loads).nodes_m;
        double apart = 0;
        double bent = 0;
        for (std::size_t n = 0; n < released.size(); ++n) {
            for (int d = 0; d < 3; ++d) {
                apart = std::max(apart, std::abs(released[n][d] - stepped.nodes_m[n][d]));
                bent = std::max(bent, std::abs(released[n][d] - body.mesh.nodes[n][d]));
            }
        }
        std::printf("two-material beam: bent %.3f L, %.2g L apart\n", bent / 8e-3,
                    apart / 8e-3);
        EXPECT_GT(bent / 8e-3, 0.05);
        // A residual of 1e-9 of the load, times a softness of (L/h)^2 = 256.
        EXPECT_LT(apart / 8e-3, 1e-6);
        EXPECT_EQ(stepped.negative_eigenvalues, 0);
    }
}

// A sign in the weight: the density of each half, about the clamped end.
TEST(TwoMaterialBeam, WeighsEachHalfWithItsOwnDensity) {
    Body body = test::soft_and_stiff_bar();
    body.clamps = {"x_min"};
    const Eigen::VectorXd load = StaticProblem(body).load({{}, {0, 0, -10}}).dead_n;
    double force = 0;
    double moment = 0;
    for (std::size_t n = 0; n < body.mesh.nodes.size(); ++n) {
        const double fz = load[static_cast<Eigen::Index>(3 * n + 2)];
        force += fz;
        moment += fz * body.mesh.nodes[n][0];
    }
    const double half_m3 = 0.5 * 8e-3 * 1e-3 * 0.5e-3;
    EXPECT_NEAR(force / (-10 * half_m3 * (1860 + 930)), 1, 1e-12);  // rounding
    EXPECT_NEAR(moment / (-10 * half_m3 * (1860 * 2e-3 + 930 * 6e-3)), 1, 1e-12);
}

}  // namespace
}  // namespace magfsi::structure
