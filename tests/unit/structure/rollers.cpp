// Faces on rollers keep one coordinate: plane strain, and planes of symmetry.
#include <gtest/gtest.h>

#include "structure/body.h"
#include "structure/equilibrium/newton.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

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
    try {
        held_axes(body);
        FAIL();
    } catch (const std::invalid_argument& fault) {
        EXPECT_NE(std::string(fault.what()).find("on rollers at lid,"),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace magfsi::structure
