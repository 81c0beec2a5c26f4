// SPDX-License-Identifier: GPL-2.0-or-later
// Equilibria under loads that are weak beside the stiffness: right at any tolerance, or
// said to be unresolved.
#include "structure/equilibrium/newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

constexpr double g0 = 9.81;

Body held_block(const Box& box, const Material& material) {
    Body body;
    body.name = "block";
    body.mesh = box_mesh(box);
    body.material = material;
    body.element = ElementVariant::assumed_strain;
    body.clamps = {"x_min"};
    return body;
}

Equilibrium under_weight(const Body& body, double gravity_m_s2, double tolerance) {
    EquilibriumOptions options;
    options.tolerance = tolerance;
    return NewtonSolver(body, options).solve({{}, {0, 0, -gravity_m_s2}});
}

// Of the middle of the free end, over the length.
double tip_rise(const Body& body, const Equilibrium& found) {
    const MaterialPoint& tip = body.mesh.centre_line.back();
    double rise = 0;
    for (int a = 0; a < 8; ++a) {
        rise += tip.weight[a] *
                (found.nodes_m[tip.node[a]][2] - body.mesh.nodes[tip.node[a]][2]);
    }
    return rise / bounds(body.mesh.nodes).extent_m()[0];
}

const Box coarse{{17.5e-3, 5e-3, 1e-3}, {18, 5, 1}};
const Material paper_beam{330e3, 6600e3, 1860};

struct Case {
    const char* name;
    Body body;
    double gravity_m_s2;
    double right;  // rise of the tip over the length
};

// The right values of the beam and the sheet are those of damped motion in LAMMPS down to
// a residual of 1e-4, which knows nothing of Newton's criterion; that of the stiff beam
// is Newton's own at a residual of 1e-9.
TEST(WeakLoads, SagTheSameAtAnyTolerance) {
    const Body beam = held_block(coarse, paper_beam);
    const Body stiff = held_block({coarse.size_m, {54, 15, 3}}, {330e3, 330e6, 1860});
    const Body sheet =
        held_block({{10e-3, 5e-3, 0.1e-3}, {40, 20, 1}}, {33e3, 660e3, 1860});
    for (const Case& c : {Case{"beam under 0.1 g", beam, 0.1 * g0, -0.0140},
                          Case{"nearly incompressible beam under 1 g", stiff, g0, -0.134},
                          Case{"sheet under 0.1 g", sheet, 0.1 * g0, -0.814},
                          Case{"sheet under 0.01 g", sheet, 0.01 * g0, -0.224}}) {
        for (const double tolerance : {1e-2, 1e-3}) {
            const Equilibrium found = under_weight(c.body, c.gravity_m_s2, tolerance);
            std::printf("%s, tolerance %g: %.5f L, %d iterations\n", c.name, tolerance,
                        tip_rise(c.body, found), found.iterations);
            EXPECT_NEAR(tip_rise(c.body, found) / c.right, 1, 0.01) << c.name;
        }
    }
}

// From 1e-1 to 1e-10 g the sag is linear.
TEST(WeakLoads, SagInProportion) {
    for (const Body& body :
         {held_block(coarse, paper_beam),
          held_block({coarse.size_m, {54, 15, 3}}, {330e3, 330e6, 1860})}) {
        const double at_hundredth =
            tip_rise(body, under_weight(body, 1e-3 * g0, 1e-9)) / 1e-3;
        for (const double share : {1e-5, 1e-7, 1e-8}) {
            const Equilibrium found = under_weight(body, share * g0, 1e-6);
            EXPECT_TRUE(found.resolved());
            EXPECT_NEAR(tip_rise(body, found) / share / at_hundredth, 1, 0.01) << share;
        }
    }
}

// theta'' = -load (1 - s) cos(theta), theta(0) = 0, theta'(1) = 0: a heavy elastica, by
// shooting with the classical Runge-Kutta method. Returns the sag over the length.
double heavy_elastica(double load) {
    const auto shoot = [load](double curvature, double& sag) {
        constexpr int steps = 2000;
        double theta = 0, slope = curvature;
        sag = 0;
        for (int i = 0; i < steps; ++i) {
            const double h = 1.0 / steps, s = i * h;
            const auto bend = [load](double at, double angle) {
                return -load * (1 - at) * std::cos(angle);
            };
            const double k1 = bend(s, theta), t1 = slope;
            const double t2 = slope + h / 2 * k1,
                         k2 = bend(s + h / 2, theta + h / 2 * t1);
            const double t3 = slope + h / 2 * k2,
                         k3 = bend(s + h / 2, theta + h / 2 * t2);
            const double t4 = slope + h * k3, k4 = bend(s + h, theta + h * t3);
            const double before = theta;
            theta += h / 6 * (t1 + 2 * t2 + 2 * t3 + t4);
            slope += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
            sag += h / 2 * (std::sin(before) + std::sin(theta));
        }
        return slope;
    };
    double low = 0, high = load, sag = 0;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (shoot(middle, sag) > 0 ? high : low) = middle;
    }
    return sag;
}

TEST(WeakLoads, BendASlenderRodAsTheElasticaHasIt) {
    // A rod of square section, L/h = 100: 0.4 % of the length is in the clamp and in
    // shear.
    const Body rod =
        held_block({{10e-3, 0.1e-3, 0.1e-3}, {100, 1, 1}}, {33e3, 660e3, 1860});
    const double young_pa = 62.0 / 21 * 33e3;
    for (const double gravity : {0.1 * g0, 0.01 * g0, 1e-5 * g0}) {
        const double load = 12 * 1860 * gravity * 1e-6 / (young_pa * 1e-8);
        const double sag = -tip_rise(rod, under_weight(rod, gravity, 1e-2));
        std::printf("load %.3g: sag %.6g L, elastica %.6g L\n", load, sag,
                    heavy_elastica(load));
        EXPECT_NEAR(sag / heavy_elastica(load), 1, 0.01);
    }
}

TEST(WeakLoads, AreNamedWhereRoundingHidesThem) {
    const Body body = held_block(coarse, paper_beam);
    EXPECT_FALSE(under_weight(body, 1e-13 * g0, 1e-6).resolved());
    EXPECT_TRUE(NewtonSolver(body).solve({}).resolved());
    Body magnet = body;
    magnet.clamps.clear();
    magnet.magnetization_a_m = uniform_magnetization(magnet.mesh, {0, 0, 1e3});
    test::expect_refusal<std::runtime_error>(
        [&] {
            relaxed_shape(magnet, {0, 0, 1e-18});
        },
        {"body block: its loads are too weak"});
}

}  // namespace
}  // namespace magfsi::structure
