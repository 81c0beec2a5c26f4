// SPDX-License-Identifier: GPL-2.0-or-later
// Moments of inertia of lumped and corrected masses against the continuum's.
#include "structure/lattice/inertia.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "structure/lattice/lattice.h"
#include "structure/lattice/stable_step.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

Body block(const Box& box, Inertia inertia) {
    Body body;
    body.name = "block";
    body.mesh = box_mesh(box);
    body.material = test::soft_material();
    body.inertia = inertia;
    return body;
}

double largest(const Vec3& v) {
    return std::ranges::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

// The trapezium rule's: 2 / n^2 of the second moment along an axis of n elements.
TEST(Inertia, OfLumpedMassesIsTooLargeAsTheTrapeziumRuleSays) {
    for (const int n : {1, 2, 4}) {
        const Vec3 error = inertia_error(block({{1, 1, 1}, {n, n, n}}, Inertia::lumped));
        for (const double e : error) EXPECT_NEAR(e, 2.0 / (n * n), 1e-12);
    }
}

TEST(Inertia, OfCorrectedMassesIsRightFromTwoElementsOn) {
    for (const Box& box : {Box{{1, 1, 1}, {2, 2, 2}}, Box{{1, 1, 1}, {4, 4, 4}},
                           Box{{2, 1, 1}, {4, 2, 2}}, Box{{3, 2, 1}, {7, 3, 2}}}) {
        const Body body = block(box, Inertia::corrected);
        EXPECT_LT(largest(inertia_error(body)), 1e-6);
        const auto mass = build_lattice(body).node_mass_kg;
        const double volume = box.size_m[0] * box.size_m[1] * box.size_m[2];
        EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.0) / (1860 * volume), 1,
                    1e-12);
        EXPECT_GT(std::ranges::min(mass), 0);
    }
}

TEST(Inertia, OfASkewedMeshIsRightToo) {
    Body body = block({{2, 1, 1}, {6, 3, 3}}, Inertia::lumped);
    for (Vec3& x : body.mesh.nodes) x[0] += 0.2 * x[2] + 0.1 * x[1];
    EXPECT_GT(largest(inertia_error(body)), 0.1);
    body.inertia = Inertia::corrected;
    EXPECT_LT(largest(inertia_error(body)), 0.01);
}

// Centre of mass of a frustum of height h whose top has s times the side of its base:
// h / 4 (1 + 2 s + 3 s^2) / (1 + s + s^2). An element has it exactly by its four upper
// nodes, for the integrals of N_a x_a add up to that of x.
TEST(Inertia, OfAFrustumHasItsCentreOfMass) {
    constexpr double h = 0.7, s = 0.4;
    Body body = block({{1, 1, h}, {1, 1, 1}}, Inertia::lumped);
    for (Vec3& x : body.mesh.nodes) {
        for (const int d : {0, 1}) x[d] = 0.5 + (x[d] - 0.5) * (x[2] > 0 ? s : 1);
    }
    const auto masses = element_masses_kg(body)[0];
    double mass = 0, moment = 0;
    for (int a = 0; a < 8; ++a) {
        mass += masses[a];
        moment += masses[a] * body.mesh.nodes[body.mesh.elements[0][a]][2];
    }
    EXPECT_NEAR(mass / (1860 * h * (1 + s + s * s) / 3), 1, 1e-12);
    EXPECT_NEAR(moment / mass, h / 4 * (1 + 2 * s + 3 * s * s) / (1 + s + s * s), 1e-12);
}

// What it costs: lighter nodes on the surface.
TEST(Inertia, CostsLittleOfTheStableStep) {
    for (const Box& box :
         {Box{{3.7e-3, 1.5e-3, 0.185e-3}, {20, 8, 1}},
          Box{{17.5e-3, 5e-3, 1e-3}, {18, 5, 1}}, Box{{1e-3, 1e-3, 1e-3}, {2, 2, 2}},
          Box{{1e-3, 1e-3, 1e-3}, {4, 4, 4}}}) {
        const double share = stable_step_s(block(box, Inertia::corrected)) /
                             stable_step_s(block(box, Inertia::lumped));
        std::printf("%d x %d x %d: stable step times %.3f\n", box.elements[0],
                    box.elements[1], box.elements[2], share);
        EXPECT_GT(share, 0.75);
        EXPECT_LE(share, 1 + 1e-12);
    }
}

}  // namespace
}  // namespace magfsi::structure
