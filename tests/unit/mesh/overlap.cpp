#include "structure/mesh/overlap.h"

#include <gtest/gtest.h>

#include "tests/unit/mesh/meshes.h"

namespace magfsi::structure {
namespace {

Mesh moved(Mesh mesh, const Vec3& by_m) {
    for (Vec3& x : mesh.nodes) {
        for (int d = 0; d < 3; ++d) x[d] += by_m[d];
    }
    return mesh;
}

const Mesh plate = box_mesh({{4e-3, 2e-3, 0.2e-3}, {8, 4, 1}});

TEST(Overlap, BodiesApartAndBodiesThatTouchDoNot) {
    EXPECT_FALSE(bodies_overlap(plate, moved(plate, {0, 0, 1e-3})));
    EXPECT_FALSE(bodies_overlap(plate, moved(plate, {0, 0, 0.2e-3})));
    EXPECT_FALSE(bodies_overlap(plate, moved(plate, {4e-3, 0.3e-3, 0.1e-3})));
}

TEST(Overlap, BoundingBoxesThatMeetAreNotEnough) {
    // Two L-shaped bodies, one in the other's corner.
    Mesh corner = box_mesh({{3, 3, 1}, {3, 3, 1}});
    corner.elements = {corner.elements[0], corner.elements[1], corner.elements[2],
                       corner.elements[3], corner.elements[6]};
    EXPECT_FALSE(
        bodies_overlap(corner, moved(box_mesh({{1, 1, 1}, {1, 1, 1}}), {1.5, 1.5, 0})));
    EXPECT_TRUE(
        bodies_overlap(corner, moved(box_mesh({{1, 1, 1}, {1, 1, 1}}), {1.5, 0.9, 0})));
}

TEST(Overlap, TheSameBodyTwiceOverlaps) {
    EXPECT_TRUE(bodies_overlap(plate, plate));
    EXPECT_TRUE(bodies_overlap(plate, moved(plate, {0.5e-3, 0, 0})));  // by an element
}

TEST(Overlap, NamesAPointOfBoth) {
    const Mesh other = moved(plate, {3.9e-3, 0.1e-3, 0.15e-3});
    const auto overlap = bodies_overlap(plate, other);
    ASSERT_TRUE(overlap);
    EXPECT_GE(overlap->at_m[0], 3.9e-3 - 1e-12);  // rounding of the shifts
    EXPECT_LE(overlap->at_m[0], 4e-3 + 1e-12);
    EXPECT_GE(overlap->at_m[2], 0.15e-3 - 1e-12);
    EXPECT_LE(overlap->at_m[2], 0.2e-3 + 1e-12);
    EXPECT_GT(overlap->depth_m, 0);
}

TEST(Overlap, PlatesThatCrossWithoutANodeInsideAreFound) {
    // Coarse elements: the crossing lies inside the faces of single elements.
    const Mesh flat = box_mesh({{3, 3, 0.1}, {1, 1, 1}});
    const Mesh upright = moved(box_mesh({{0.1, 3, 3}, {1, 1, 1}}), {1.07, 0.3, -1.3});
    EXPECT_TRUE(bodies_overlap(flat, upright));
    EXPECT_TRUE(bodies_overlap(upright, flat));
}

TEST(Overlap, ASmallBodyInsideAnElementIsFoundFromBothSides) {
    const Mesh large = box_mesh({{1, 1, 1}, {1, 1, 1}});
    const Mesh small = moved(box_mesh({{0.01, 0.01, 0.01}, {1, 1, 1}}), {0.2, 0.7, 0.1});
    const auto overlap = bodies_overlap(small, large);
    ASSERT_TRUE(overlap);
    EXPECT_EQ(overlap->of_body, 0);
    ASSERT_TRUE(bodies_overlap(large, small));
    EXPECT_EQ(bodies_overlap(large, small)->of_body, 1);
}

}  // namespace
}  // namespace magfsi::structure
