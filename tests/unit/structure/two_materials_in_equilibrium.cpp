// Statics of a bar of two materials: springs in series, and two ways to one shape.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "structure/equilibrium/newton.h"
#include "tests/unit/structure/two_materials.h"

namespace magfsi::structure {
namespace {

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
    const Eigen::VectorXd load = StaticProblem(body).load({{}, {0, 0, -10}});
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
