#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "structure/equilibrium/newton.h"
#include "structure/magnetics/magnetization.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

Body cantilever() {
    Body body;
    body.name = "beam";
    body.mesh = box_mesh({{20e-3, 1e-3, 1e-3}, {20, 1, 1}});
    body.material = {330e3, 6600e3, 1000};
    body.element = ElementVariant::assumed_strain;
    body.clamps = {"x_min"};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {33e3, 0, 0});
    return body;
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
        for (std::size_t n = 0; n < alone.nodes_m.size(); ++n) {
            for (int d = 0; d < 3; ++d) {
                // A residual of 1e-9 of the load, times the beam's softness of 1e3.
                EXPECT_NEAR(alone.nodes_m[n][d], followed[i].nodes_m[n][d], 1e-6 * 20e-3);
            }
        }
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
        for (int d = 0; d < 3; ++d) {
            ends[d] += line.back().weight[a] * found.nodes_m[line.back().node[a]][d] -
                       line.front().weight[a] * found.nodes_m[line.front().node[a]][d];
        }
    }
    // Residual 1e-9 over the torque's own stiffness, which the same field makes.
    EXPECT_NEAR(ends[0] / 20e-3, 0, 1e-6);
    EXPECT_GT(ends[2], 19.9e-3);
    EXPECT_EQ(found.negative_eigenvalues, 0);
}

void expect_refused(const std::function<void()>& act, const std::string& part) {
    try {
        act();
        FAIL() << "nothing thrown";
    } catch (const std::exception& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
            << error.what();
    }
}

TEST(Newton, RefusesWhatHasNoEquilibrium) {
    Body body = cantilever();
    expect_refused([&] { NewtonSolver(body).follow({}, {}, {}); },
                   "body beam: 0 start positions found for 84 nodes");
    body.clamps = {"left"};
    expect_refused([&] { NewtonSolver{body}; },
                   "body beam is clamped at \"left\", but its faces are x_max, x_min,");
    body.clamps.clear();
    expect_refused(
        [&] {
            NewtonSolver(body).solve({{}, {0, 0, -9.81}});
        },
        "body beam has weight but no clamp");
}

TEST(Newton, NamesTheBodyTheLoadAndThePlaceWhereItFails) {
    Body body = cantilever();
    expect_refused(
        [&] {
            NewtonSolver(body).solve({{0, 0, 1e4}, {}});
        },
        "body beam: no equilibrium at");
}

}  // namespace
}  // namespace magfsi::structure
