// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies that stiffen against closed forms, up to 90 % of the limiting stretch, and their
// equilibria.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "structure/equilibrium/newton.h"
#include "structure/lattice/stiffening.h"
#include "tests/unit/structure/rubber.h"

namespace magfsi::structure {
namespace {

using test::root;
using test::rubber;

// Nearly incompressible, so that the closed forms are those of textbooks: the volume
// changes by stress / K, below 1e-4 of the stretches' effect.
Material incompressible(const Stiffening& law) {
    Material material = rubber(law);
    material.lame_lambda_pa = 1e5 * material.shear_modulus_pa;
    return material;
}

struct Mode {
    const char* name;
    std::vector<std::string> pulled;        // faces held along their normals
    std::function<Vec3(double)> stretches;  // of the first, incompressible
};

const std::vector<Mode>& modes() {
    static const std::vector<Mode> all{
        {"uniaxial",
         {"x_max"},
         [](double a) {
             return Vec3{a, 1 / std::sqrt(a), 1 / std::sqrt(a)};
         }},
        {"equibiaxial",
         {"x_max", "y_max"},
         [](double a) {
             return Vec3{a, a, 1 / (a * a)};
         }},
        {"pure shear",
         {"x_max", "y_max"},
         [](double a) {
             return Vec3{a, 1, 1 / a};
         }},
    };
    return all;
}

double invariant(const Vec3& stretches) {
    return dot(stretches, stretches);
}

// The cube, its faces at 0 on rollers, stretched affinely and let go.
double nominal_stress_pa(Body body, const Mode& mode, double stretch) {
    const auto roller = [&](const std::string& face) {
        body.rollers.push_back({{face}, face[0] - 'x'});
    };
    for (const char* face : {"x_min", "y_min", "z_min"}) roller(face);
    for (const std::string& face : mode.pulled) roller(face);
    const Vec3 stretches = mode.stretches(stretch);
    std::vector<Vec3> start = body.mesh.nodes;
    for (Vec3& x : start) {
        for (std::size_t d = 0; d < 3; ++d) x[d] *= stretches[d];
    }
    const Equilibrium found = NewtonSolver(body, {1e-8}).release(start, {});
    double pull_n = 0;
    for (const int node : body.mesh.faces.at("x_max")) pull_n += found.support_n[node][0];
    return pull_n / 1e-6;
}

TEST(StiffBody, FollowsTheClosedFormsTo90PercentOfTheLimit) {
    const struct {
        const char* name;
        Stiffening law;
        double limit;  // of I1 - 3
    } laws[] = {{"Gent", Gent{20}, 20},
                {"Arruda-Boyce", ArrudaBoyce{3}, 24},
                {"Yeoh", Yeoh{-1e3, 0.1e3}, 20}};  // no limit: as far as Gent's
    for (const auto& [name, law, limit] : laws) {
        for (const Mode& mode : modes()) {
            Body body;
            body.name = name;
            body.mesh = box_mesh({{1e-3, 1e-3, 1e-3}, {2, 2, 2}});
            body.material = incompressible(law);
            const StiffeningLaw factor = stiffening_law(body.material);
            const double most =
                root([&](double a) { return invariant(mode.stretches(a)) - 3 - limit; },
                     1, 100);
            double worst = 0;
            for (const double share : {0.3, 0.5, 0.7, 0.8, 0.9}) {
                const double a = share * most;
                if (a < 1.05) continue;
                const Vec3 stretches = mode.stretches(a);
                // dW/da1 - (a3/a1) dW/da3 of the nominal stress along the first axis.
                const double expected =
                    body.material.shear_modulus_pa *
                    stiffening_at(factor, invariant(stretches) - 3).factor *
                    (stretches[0] - stretches[2] * stretches[2] / stretches[0]);
                const double found = nominal_stress_pa(body, mode, a);
                worst = std::max(worst, std::abs(found / expected - 1));
            }
            std::printf("%s, %s to a stretch of %.2f: %.1e\n", name, mode.name,
                        0.9 * most, worst);
            EXPECT_LT(worst, 1e-3);
        }
    }
}

TEST(StiffBody, IsFoundByNewtonQuadratically) {
    Body body;
    body.name = "block";
    body.mesh = test::distorted_block({{1e-3, 1e-3, 1e-3}, {2, 2, 2}}, 3e-5, 3);
    body.material = rubber(Gent{5});
    body.clamps = {"x_min", "x_max"};
    StaticProblem problem(body);
    Eigen::VectorXd start = flat_positions(body.mesh.nodes);
    for (Eigen::Index q = 0; q < start.size(); q += 3) start[q] *= 1.8;
    const NodalLoads none = problem.load({});
    const Iterate found = energy_descent(problem, start, none, {0, 1e-13}, 60);
    test::Random random(4);
    Eigen::VectorXd x = found.x;
    for (Eigen::Index q = 0; q < x.size(); ++q)
        if (!held_axes(body)[q / 3][q % 3]) x[q] += 1e-6 * random.uniform();
    std::vector<double> error;
    for (int step = 0; step < 4; ++step) {
        error.push_back((x - found.x).cwiseAbs().maxCoeff() / 1e-3);
        problem.assemble(x, none);
        ASSERT_TRUE(problem.matrix().factorize());
        x += problem.matrix().solve(problem.response(x, none).residual_n);
    }
    std::printf("errors %.1e %.1e %.1e %.1e\n", error[0], error[1], error[2], error[3]);
    // Each error is the square of the one before, times the curvature of the law and of
    // the volume term; the last is rounding.
    EXPECT_LT(error[1], 100 * error[0] * error[0]);
    EXPECT_LT(error[2], std::max(100 * error[1] * error[1], 1e-11));
}

TEST(StiffBody, BeyondItsLimitIsRefusedWithItsPlace) {
    Body body;
    body.name = "block";
    body.mesh = box_mesh({{1e-3, 1e-3, 1e-3}, {2, 2, 2}});
    body.material = rubber(Gent{1});
    body.clamps = {"x_min", "x_max"};
    std::vector<Vec3> start = body.mesh.nodes;
    for (Vec3& x : start) x[0] *= 2;
    try {
        NewtonSolver(body).release(start, {});
        FAIL();
    } catch (const std::runtime_error& fault) {
        EXPECT_NE(std::string(fault.what()).find("of the limit of its material"),
                  std::string::npos)
            << fault.what();
    }
}

}  // namespace
}  // namespace magfsi::structure
