// Two independent ways to one equilibrium: the sparse Newton solution, and damped
// dynamics with the fast kernel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "structure/equilibrium/newton.h"
#include "structure/equilibrium/relax.h"
#include "structure/magnetics/magnetization.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

// Root of the mean square distance of the nodes, over the length. Nothing turns the strip
// out of its plane of symmetry, so that the turn about the field, which costs no energy,
// needs no care.
double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double length_m) {
    double sum = 0;
    for (std::size_t n = 0; n < a.size(); ++n) {
        for (int d = 0; d < 3; ++d) sum += std::pow(a[n][d] - b[n][d], 2);
    }
    return std::sqrt(sum / static_cast<double>(a.size())) / length_m;
}

// Damped dynamics stops at 1e-6 of the load; a slender body answers a force of that size
// with about (L/h)^2 = 300 to 400 times 1e-6 / 12.
constexpr double tolerance = 1e-4;

TEST(Newton, AgreesWithDampedDynamicsOnTheBeam) {
    Body body;
    body.name = "beam";
    body.mesh = box_mesh({{17.5e-3, 5e-3, 1e-3}, {18, 4, 2}});
    body.material = {330e3, 6600e3, 1000};
    body.clamps = {"x_min"};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {330e3, 0, 0});
    for (ElementVariant variant : test::all_variants) {
        body.element = variant;
        const StaticLoads loads{{0, 0, 0.002}, {}};
        const Equilibrium newton = NewtonSolver(body).solve(loads);
        const double apart =
            distance(newton.nodes_m, relax(body, loads.field_t).nodes_m, 17.5e-3);
        std::printf("beam: %.2e L apart, %d iterations\n", apart, newton.iterations);
        EXPECT_LT(apart, tolerance);
        EXPECT_LT(newton.residual, 1e-9);
        EXPECT_EQ(newton.negative_eigenvalues, 0);
        for (int node : body.mesh.faces.at("x_min")) {
            EXPECT_EQ(newton.nodes_m[node], body.mesh.nodes[node]);
        }
    }
}

TEST(Newton, AgreesWithDampedDynamicsOnTheStripAsVAndC) {
    Body body;
    body.name = "strip";
    body.mesh = box_mesh({{3.7e-3, 1.5e-3, 0.185e-3}, {20, 4, 2}});
    body.material = test::soft_material();
    body.element = ElementVariant::assumed_strain;
    const double pi = std::numbers::pi;
    body.magnetization_a_m =
        harmonic_magnetization(body.mesh, {62e3, 3.7e-3, pi / 4, 0, 2});
    NewtonSolver solver(body);
    for (double degrees : {45.0, 225.0}) {
        const double angle = degrees * pi / 180;
        const StaticLoads loads{{5e-3 * std::cos(angle), 0, 5e-3 * std::sin(angle)}, {}};
        const Equilibrium newton = solver.solve(loads);
        const double apart =
            distance(newton.nodes_m, relax(body, loads.field_t).nodes_m, 3.7e-3);
        std::printf("strip at %g: %.2e L apart, %d iterations\n", degrees, apart,
                    newton.iterations);
        EXPECT_LT(apart, tolerance);
        EXPECT_EQ(newton.negative_eigenvalues, 0);
    }
}

}  // namespace
}  // namespace magfsi::structure
