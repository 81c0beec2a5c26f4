#include "structure/mesh/locate.h"

#include <gtest/gtest.h>

#include "structure/mesh/block_mesh.h"
#include "structure/mesh/body_points.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const Box box{{3e-3, 1e-3, 0.2e-3}, {6, 3, 2}};

// Rounding of coordinates of millimetres and of Newton's last step.
constexpr double rounding_m = 1e-16;

TEST(Locate, SameAsTheBlocksOwnInsideAndOutside) {
    const Mesh mesh = box_mesh(box);
    const PointLocator locator(mesh);
    test::Random random(4);
    for (int trial = 0; trial < 2000; ++trial) {
        Vec3 point{};
        for (int d = 0; d < 3; ++d) {
            point[d] = box.size_m[d] * random.within(-0.3, 1.3);
        }
        const MaterialPoint expected = locate(box, point);
        const MaterialPoint found = locator.nearest(point);
        ASSERT_EQ(found.element, expected.element) << trial;
        // Weights change by 1 over an edge of 1e-4 m.
        for (int a = 0; a < 8; ++a) {
            EXPECT_NEAR(found.weight[a], expected.weight[a], rounding_m / 1e-4 + 1e-14);
        }
    }
}

TEST(Locate, NodesOfABlockAndEveryBorderGoToTheSameElementAsTheBlocksOwn) {
    const Mesh mesh = box_mesh(box);
    const PointLocator locator(mesh);
    for (const Vec3& node : mesh.nodes) {
        EXPECT_LT(test::distance(position(mesh, locator.nearest(node)), node),
                  rounding_m);
    }
    // Coordinates without rounding: grid lines at whole numbers.
    const Box whole{{3, 2, 2}, {3, 2, 2}};
    const Mesh whole_mesh = box_mesh(whole);
    const PointLocator whole_locator(whole_mesh);
    for (const Vec3& node : whole_mesh.nodes) {
        EXPECT_EQ(whole_locator.nearest(node).element, locate(whole, node).element);
    }
}

TEST(Locate, FindsPointsOfADistortedMesh) {
    // Corners off by up to a fifth of the thickness of an element.
    const Mesh mesh = test::distorted_block(box, 2e-5, 8);
    ASSERT_GT(volume_m3(mesh), 0);
    const PointLocator locator(mesh);
    test::Random random(9);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        for (int trial = 0; trial < 50; ++trial) {
            MaterialPoint point;
            point.node = mesh.elements[e];
            point.weight =
                shape_values({random.within(-0.999, 0.999), random.within(-0.999, 0.999),
                              random.within(-0.999, 0.999)});
            const auto found = locator.find(position(mesh, point));
            ASSERT_TRUE(found) << "element " << e;
            EXPECT_EQ(found->element, static_cast<int>(e));
            for (int a = 0; a < 8; ++a) {
                // Newton stops at 1e-12 of the element at worst.
                EXPECT_NEAR(found->weight[a], point.weight[a], 1e-11);
            }
        }
    }
}

TEST(Locate, PointsOutsideADistortedMeshAreNotFoundAndGoToTheNearestSurfacePoint) {
    const Mesh mesh = test::distorted_block(box, 2e-5, 8);
    const PointLocator locator(mesh);
    test::Random random(10);
    int outside = 0;
    for (int trial = 0; trial < 300; ++trial) {
        Vec3 point{};
        for (int d = 0; d < 3; ++d) {
            point[d] = box.size_m[d] * 0.5 + 4e-3 * random.within(-1, 1);
        }
        if (locator.find(point)) continue;
        ++outside;
        const double away = test::distance(position(mesh, locator.nearest(point)), point);
        // No surface node is nearer.
        for (const Vec3& node : mesh.nodes) {
            EXPECT_LE(away, test::distance(node, point) + rounding_m);
        }
    }
    EXPECT_GT(outside, 250);  // the block fills a thousandth of the sampled cube
}

TEST(Locate, PointsJustOutsideAreFoundWithATolerance) {
    // Oblique borders: the element of a point outside may be entered in other bins only.
    const Mesh mesh = oblique_mesh({6, 4, 1, 1, 0.6, 0.2, {3, 3, 2}});
    const PointLocator locator(mesh);
    int moved = 0;
    for (const SurfaceQuad& quad : boundary_quads(mesh)) {
        const Vec3 area = quad_area_vector(corners(mesh.nodes, quad.node));
        const double norm = quad_area(corners(mesh.nodes, quad.node));
        Vec3 at{};
        for (int d = 0; d < 3; ++d) {
            for (const int node : quad.node) at[d] += 0.25 * mesh.nodes[node][d];
            at[d] += 2e-5 * area[d] / norm;  // 4e-4 of the thinnest element, 2 across
        }
        EXPECT_FALSE(locator.find(at));
        const auto found = locator.find(at, 1e-3);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->element, quad.element);
        // Local coordinates are not perpendicular: the border's point is up to
        // 1 / sin(0.6) as far away as the foot.
        EXPECT_LT(test::distance(position(mesh, *found), at), 2e-5 / 0.56);
        ++moved;
    }
    EXPECT_EQ(moved, 2 * (18 * 12 + 18 * 2 + 12 * 2));
}

TEST(Locate, RefusesPointsThatAreNotFinite) {
    EXPECT_THROW(locate(box_mesh(box), {NAN, 0, 0}), std::invalid_argument);
    EXPECT_THROW(locate(Mesh{}, {0, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
