// SPDX-License-Identifier: GPL-2.0-or-later
// Surfaces that come near each other or pass through each other.
#include "structure/mesh/proximity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "structure/mesh/block_mesh.h"

namespace magfsi::structure {
namespace {

constexpr double near_m = 1e-4;

// A strip of 40 thin elements, and two short plates.
const Mesh strip = box_mesh({{4e-3, 1e-3, 0.2e-3}, {40, 4, 1}});
const Mesh plate = box_mesh({{1e-3, 1e-3, 0.2e-3}, {5, 5, 2}});

Proximities meet(const std::vector<const Mesh*>& bodies, const std::vector<Vec3>& nodes) {
    return ProximityFinder(bodies, near_m).find(nodes);
}

// Rolled up about y: radius_m at the start, more by rise_m with every turn.
std::vector<Vec3> rolled(double radius_m, double rise_m) {
    std::vector<Vec3> nodes;
    for (const Vec3& x : strip.nodes) {
        const double angle = x[0] / radius_m;
        const double r = radius_m + rise_m * angle / (2 * M_PI) - x[2];
        nodes.push_back({r * std::cos(angle), x[1], r * std::sin(angle)});
    }
    return nodes;
}

std::vector<Vec3> with_moved_copy(const Vec3& by_m, double turn = 0) {
    std::vector<Vec3> nodes = plate.nodes;
    for (const Vec3& x : plate.nodes) {
        const double c = std::cos(turn), s = std::sin(turn);
        nodes.push_back({c * x[0] - s * x[2] + by_m[0], x[1] + by_m[1],
                         s * x[0] + c * x[2] + by_m[2]});
    }
    return nodes;
}

TEST(Proximity, BodiesAtRestMeetNothing) {
    for (const Mesh* mesh : {&strip, &plate}) {
        const auto found = meet({mesh}, mesh->nodes);
        EXPECT_FALSE(found.crossing);
        EXPECT_TRUE(found.near.empty());
        EXPECT_GT(found.apart_m, near_m);
    }
}

TEST(Proximity, ARollMeetsItselfWhereItsTurnsAreCloserThanItIsThick) {
    // 1.27 turns of a strip 0.2 mm thick.
    for (const double rise : {0.15e-3, 0.1e-3, 0.0}) {
        const auto found = meet({&strip}, rolled(0.5e-3, rise));
        ASSERT_TRUE(found.crossing) << rise;
        EXPECT_EQ(found.crossing->body[1], 0U);
    }
    const auto clear = meet({&strip}, rolled(0.5e-3, 0.6e-3));
    EXPECT_FALSE(clear.crossing);
    EXPECT_TRUE(clear.near.empty());
}

TEST(Proximity, ABentStripThatStaysOpenMeetsNothing) {
    // Nearly a ring, its ends ten thicknesses apart, and one as tight as it can be bent.
    EXPECT_TRUE(meet({&strip}, rolled(1e-3, 0)).near.empty());
    EXPECT_FALSE(meet({&strip}, rolled(0.75e-3, 0)).crossing);
}

TEST(Proximity, TheGapOfTwoPlatesIsTheirDistance) {
    for (const double gap : {0.9e-4, 0.3e-4, 0.01e-4}) {
        const auto found =
            meet({&plate, &plate}, with_moved_copy({0.33e-4, 0.21e-4, 0.2e-3 + gap}));
        EXPECT_FALSE(found.crossing);
        ASSERT_EQ(found.near.size(), 1U);
        EXPECT_NEAR(found.near[0].gap_m, gap, 1e-12);
        EXPECT_NEAR(found.apart_m, gap, 1e-12);
    }
    // What is further away is known to be, as far as is looked.
    const auto far = meet({&plate, &plate}, with_moved_copy({0, 0, 0.2e-3 + 1.5e-4}));
    EXPECT_TRUE(far.near.empty());
    EXPECT_LE(far.apart_m, 1.5e-4 + 1e-12);
    EXPECT_GE(far.apart_m, near_m);
}

TEST(Proximity, WhatTouchesDoesNotCross) {
    EXPECT_FALSE(meet({&plate, &plate}, with_moved_copy({0, 0, 0.2e-3})).crossing);
    EXPECT_FALSE(meet({&plate, &plate}, with_moved_copy({1e-3, 0, 0})).crossing);
}

TEST(Proximity, PlatesThatGoThroughEachOtherCross) {
    // Flat into flat, crosswise, with a corner, and an edge between nodes.
    for (const Vec3& by : {Vec3{0.03e-3, 0.05e-3, 0.19e-3}, Vec3{0.9e-3, 0.93e-3, 0.1e-3},
                           Vec3{0.99e-3, 0.99e-3, 0.19e-3}}) {
        const auto found = meet({&plate, &plate}, with_moved_copy(by));
        ASSERT_TRUE(found.crossing);
        EXPECT_EQ(found.crossing->body, (std::array<std::size_t, 2>{0, 1}));
        EXPECT_EQ(found.apart_m, 0);
    }
    for (const double turn : {0.3, 1.0, M_PI / 2})
        EXPECT_TRUE(
            meet({&plate, &plate}, with_moved_copy({0.5e-3, 0.1e-3, -0.1e-3}, turn))
                .crossing);
}

// A look may not miss what lies between two of them: the surfaces of a plate that falls
// through another cross from the first touch to the last.
TEST(Proximity, AFallThroughAPlateIsSeenAllTheWay) {
    for (double z = 0.399e-3; z > 0.001e-3; z -= 0.01e-3) {
        const auto found =
            meet({&plate, &plate}, with_moved_copy({0.41e-3, 0.43e-3, z - 0.2e-3}));
        EXPECT_TRUE(found.crossing) << z;
    }
}

}  // namespace
}  // namespace magfsi::structure
