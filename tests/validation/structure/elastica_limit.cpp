// A cantilever that gets thinner tends to the hard-magnetic elastica (elastica.csv, plane
// stress): the rod load is lambda = 12 gamma (L/H)^2 G/E with E/G = 62/21 for K = 20 G.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/validation/structure/reference_table.h"
#include "tests/validation/structure/static_bodies.h"

namespace magfsi::structure {
namespace {

constexpr double length_m = 17.5e-3;

// Rise and retreat of the tip at each lambda; width and thickness are the same, which
// leaves the section free to curl as plane stress has it.
std::vector<Vec3> tips(double slenderness, const std::array<int, 3>& n,
                       const std::vector<double>& lambdas) {
    const double height = length_m / slenderness;
    const Body body =
        test::cantilever({{length_m, height, height}, n}, ElementVariant::assumed_strain);
    std::vector<double> gammas;
    for (double lambda : lambdas) {
        gammas.push_back(lambda * 62 / 21 / (12 * slenderness * slenderness));
    }
    std::vector<Vec3> out;
    for (const Equilibrium& found :
         NewtonSolver(body).follow(body.mesh.nodes, {}, test::rising_gamma(gammas))) {
        EXPECT_EQ(found.negative_eigenvalues, 0);
        out.push_back(test::tip_displacement(body, found.nodes_m));
    }
    return out;
}

struct Reference {
    std::vector<double> lambda, rise;
};
Reference reference(const std::vector<double>& lambdas) {
    Reference out;
    for (const auto& row : test::reference_table("elastica.csv")) {
        const double lambda = test::number(row, "lambda");
        if (row.at("phi_deg") != "90" || !std::ranges::count(lambdas, lambda)) continue;
        out.lambda.push_back(lambda);
        out.rise.push_back(test::number(row, "uz_tip/L"));
    }
    return out;
}

TEST(Elastica, IsTheThinLimit) {
    const Reference rod = reference({0.1, 1, 5, 20, 50});
    std::vector<double> largest;
    for (int slenderness : {16, 32, 64}) {
        const auto found = tips(slenderness, {4 * slenderness, 2, 2}, rod.lambda);
        std::printf("H/L 1/%d: error of the rise", slenderness);
        largest.push_back(0);
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double error = found[i][2] / rod.rise[i] - 1;
            largest.back() = std::max(largest.back(), std::abs(error));
            std::printf("  lambda %g: %+.3f %%", rod.lambda[i], 100 * error);
        }
        std::printf("\n");
    }
    // The clamp keeps a length of about H from curling, a share H/L of the rod; shear and
    // stretching go with (H/L)^2. Halving H thus halves the error at least, but for the
    // terms of higher order that have the other sign.
    EXPECT_GT(largest[0] / largest[1], 1.7);
    EXPECT_GT(largest[1] / largest[2], 1.7);
    EXPECT_LT(largest[2], 0.005);
}

TEST(Elastica, MeshErrorIsOfSecondOrder) {
    const std::vector<double> lambdas{0.1, 1, 5, 20};
    std::vector<std::vector<Vec3>> found;
    for (int n : {8, 16, 32, 64}) found.push_back(tips(70, {n, 1, 1}, lambdas));
    for (std::size_t i = 0; i < lambdas.size(); ++i) {
        // Over the differences between meshes, which need no exact solution.
        const double coarse = found[1][i][2] - found[0][i][2];
        const double fine = found[3][i][2] - found[2][i][2];
        const double order = 0.5 * std::log2(coarse / fine);
        std::printf("lambda %-4g rise %.6f %.6f %.6f %.6f, order %.2f\n", lambdas[i],
                    found[0][i][2], found[1][i][2], found[2][i][2], found[3][i][2],
                    order);
        // Two, and more where coarse meshes are far from the asymptotic range.
        EXPECT_GT(order, 1.9);
    }
}

}  // namespace
}  // namespace magfsi::structure
