// A beam magnetised along itself buckles in a field against it, above the rod load
// lambda = 12 gamma (L/H)^2 G/E = pi^2/4 (elastica at 180 degrees).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "structure/equilibrium/newton.h"
#include "structure/magnetics/magnetization.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

constexpr double slenderness = 30;

// Wider than thick, so that one way to buckle comes first.
Body beam() {
    Body body;
    body.name = "beam";
    const double length = 30e-3;
    const double height = length / slenderness;
    body.mesh = box_mesh({{length, 2 * height, height}, {30, 2, 1}});
    body.material = {330e3, 6600e3, 1000};
    body.element = ElementVariant::assumed_strain;
    body.clamps = {"x_min"};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {330e3, 0, 0});
    return body;
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
    const Body body = beam();
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
    const Body body = beam();
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

}  // namespace
}  // namespace magfsi::structure
