// SPDX-License-Identifier: GPL-2.0-or-later
// The surface of a mesh, and points spread over it and through the body.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include "structure/mesh/block_mesh.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"
#include "structure/mesh/mesh_check.h"
#include "structure/mesh/surface.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const Box box{{3e-3, 1e-3, 0.2e-3}, {6, 3, 2}};

TEST(Surface, QuadsLookOutward) {
    const Mesh mesh = box_mesh(box);
    const auto surface = boundary_quads(mesh);
    EXPECT_EQ(surface.size(), 2U * (6 * 3 + 6 * 2 + 3 * 2));
    for (const SurfaceQuad& quad : surface) {
        const Vec3 area = quad_area_vector(corners(mesh.nodes, quad.node));
        const int d = quad.face / 2;
        EXPECT_GT((quad.face % 2 == 1 ? 1 : -1) * area[d], 0);
        // The vector of a plane quad has its area.
        EXPECT_NEAR(std::abs(area[d]) / quad_area(corners(mesh.nodes, quad.node)), 1,
                    1e-14);
    }
}

TEST(Surface, AreaVectorsOfADistortedBlockSumToZero) {
    const Mesh mesh = test::distorted_block(box, 2e-5, 3);
    Vec3 sum{};
    for (const SurfaceQuad& quad : boundary_quads(mesh)) {
        sum += quad_area_vector(corners(mesh.nodes, quad.node));
    }
    for (double s : sum) EXPECT_NEAR(s, 0, 1e-20);  // rounding of areas of 8e-6 m2
}

TEST(Surface, AFaceOfThreeElementsIsRefused) {
    Mesh mesh = box_mesh({{2, 1, 1}, {2, 1, 1}});
    mesh.elements.push_back(mesh.elements[0]);
    EXPECT_THROW(boundary_quads(mesh), std::invalid_argument);
}

double area(const std::vector<SurfacePoint>& points) {
    double sum = 0;
    for (const SurfacePoint& point : points) sum += point.area_m2;
    return sum;
}

TEST(SurfacePoints, AreasSumToTheSurfaceAtAnySpacing) {
    const Mesh mesh = test::distorted_block(box, 2e-5, 5);
    const auto surface = boundary_quads(mesh);
    double expected = 0;
    for (const SurfaceQuad& quad : surface)
        expected += quad_area(corners(mesh.nodes, quad.node));
    for (const double spacing : {1.0, 3e-4, 1e-4, 3e-5}) {
        // Rounding of some ten thousand areas.
        EXPECT_NEAR(area(surface_points(mesh, surface, spacing)) / expected, 1, 1e-12);
    }
}

TEST(SurfacePoints, QuadsSmallerThanTheSpacingCarryOnePoint) {
    const Mesh mesh = box_mesh(box);
    const auto surface = boundary_quads(mesh);
    EXPECT_EQ(surface_points(mesh, surface, 1).size(), surface.size());
    // 0.5 x 1/3 x 0.1 mm at 0.25 mm: top and bottom 2 x 2, the sides 2 x 1.
    EXPECT_EQ(surface_points(mesh, surface, 0.25e-3).size(),
              2U * (18 * 4 + 12 * 2 + 6 * 2));
}

TEST(SurfacePoints, LieOnTheSurfaceWithOutwardNormals) {
    const Mesh mesh = box_mesh(box);
    for (const SurfacePoint& point : surface_points(mesh, boundary_quads(mesh), 1e-4)) {
        const Vec3 x = position(mesh, point.point);
        for (int d = 0; d < 3; ++d) {
            if (std::abs(point.normal[d]) < 0.5) continue;
            EXPECT_NEAR(std::abs(point.normal[d]), 1, 1e-14);
            const double wall = point.normal[d] > 0 ? box.size_m[d] : 0;
            EXPECT_NEAR(x[d], wall, 1e-17);  // rounding of millimetres
        }
        EXPECT_EQ(mesh.elements[point.point.element], point.point.node);
    }
}

// Gauss: the flux of the position vector out of a body is three times its volume.
TEST(SurfacePoints, FluxOfThePositionApproachesThreeVolumes) {
    const Mesh mesh = test::distorted_block(box, 1e-5, 6);
    const double volume = volume_m3(mesh);
    double error[2];
    const double spacing[2] = {1, 5e-5};
    for (int s = 0; s < 2; ++s) {
        double flux = 0;
        for (const SurfacePoint& p :
             surface_points(mesh, boundary_quads(mesh), spacing[s])) {
            const Vec3 x = position(mesh, p.point);
            flux += dot(x, p.normal) * p.area_m2;
        }
        error[s] = std::abs(flux / (3 * volume) - 1);
    }
    // One point a quad misses the warp of quads, of second order in 1e-5 m over 1e-4 m.
    EXPECT_LT(error[0], 1e-2);
    EXPECT_LT(error[1], 0.3 * error[0]);
}

TEST(SurfacePoints, RefusesNoSpacing) {
    const Mesh mesh = box_mesh(box);
    EXPECT_THROW(surface_points(mesh, boundary_quads(mesh), 0), std::invalid_argument);
}

const Box thick{{3e-3, 1e-3, 0.6e-3}, {3, 2, 1}};

TEST(VolumePoints, share_out_the_body) {
    Mesh mesh = box_mesh(thick);
    for (Vec3& x : mesh.nodes) x[0] *= 1 + 200 * x[1] + 100 * x[2];  // no bricks any more
    double sum = 0;
    const auto points = volume_points(mesh, 0.25e-3);
    for (const auto& p : points) sum += p.volume_m3;
    EXPECT_GT(points.size(), 3U * 2 * 3 * 4 * 2);
    EXPECT_NEAR(sum / volume_m3(mesh), 1, 1e-13);  // rounding of a hundred volumes
}

TEST(VolumePoints, are_spaced_by_at_most_what_is_asked) {
    const auto points = volume_points(box_mesh(thick), 0.25e-3);
    EXPECT_EQ(points.size(), 6U * 4 * 2 * 3);  // 1 mm, 0.5 mm, 0.6 mm in 4, 2, 3 parts
    EXPECT_THROW(volume_points(box_mesh(thick), 0), std::invalid_argument);
}

TEST(Depths, of_points_in_a_block) {
    const Mesh mesh = box_mesh(thick);
    std::vector<MaterialPoint> points;
    std::vector<double> expected;
    constexpr double limit = 0.25e-3;
    for (const auto& p : volume_points(mesh, 0.2e-3)) {
        points.push_back(p.point);
        const Vec3 x = position(mesh, p.point);
        double least = limit;
        for (int d = 0; d < 3; ++d)
            least = std::min({least, x[d], thick.size_m[d] - x[d]});
        expected.push_back(least);
    }
    constexpr double spacing = 0.02e-3;
    const auto found = depths(mesh, boundary_quads(mesh), points, spacing, limit);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_GE(found[i], expected[i] * (1 - 1e-12));
        // Half the diagonal of four surface points off to the side.
        EXPECT_LE(found[i],
                  std::hypot(expected[i], spacing / std::sqrt(2.0)) * (1 + 1e-12));
    }
}

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
        Vec3 at{};
        for (const int node : quad.node) at += 0.25 * mesh.nodes[node];
        at += 2e-5 * area / norm(area);  // 4e-4 of the thinnest element, 2 across
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

TEST(MeshCheck, UnusedNodesGoAndNamesFollow) {
    Mesh mesh = box_mesh({{3, 1, 1}, {3, 1, 1}});
    mesh.elements.erase(mesh.elements.begin());  // the nodes of x = 0 are free
    mesh.centre_line.clear();
    mesh.points["end"] = {3};
    EXPECT_EQ(drop_unused_nodes(mesh), 4);
    EXPECT_EQ(mesh.nodes.size(), 12U);
    EXPECT_TRUE(mesh.faces.at("x_min").empty());
    EXPECT_EQ(mesh.nodes[mesh.points.at("end")[0]], (Vec3{3, 0, 0}));
    EXPECT_NEAR(volume_m3(mesh), 2, 1e-14);
}

TEST(MeshCheck, CoincidentNodesAreFoundAcrossCellsOfTheSearch) {
    test::Random random(2);
    const double tolerance = 1e-3;
    for (int trial = 0; trial < 200; ++trial) {
        Mesh mesh = box_mesh({{1, 1, 1}, {3, 3, 3}});
        const int node = static_cast<int>(random.within(0, 63.99));
        Vec3 twin = mesh.nodes[node];
        const double step = tolerance * random.within(-1, 1) * 0.57;  // below 1/sqrt(3)
        for (double& x : twin) x += step;
        mesh.nodes.push_back(twin);
        const auto found = coincident_nodes(mesh, tolerance);
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, (std::array{node, 64}));
        mesh.nodes.back()[0] += 3 * tolerance;
        EXPECT_FALSE(coincident_nodes(mesh, tolerance));
    }
}

TEST(MeshCheck, PartsAndTwinsAreCounted) {
    Mesh mesh = box_mesh({{5, 1, 1}, {5, 1, 1}});
    EXPECT_FALSE(duplicate_elements(mesh));
    mesh.elements.erase(mesh.elements.begin() + 2);
    EXPECT_EQ(connected_parts(mesh), (std::vector<int>{0, 0, 1, 1}));
    mesh.elements.push_back(mesh.elements[1]);
    EXPECT_EQ(*duplicate_elements(mesh), (std::array{1, 4}));
    EXPECT_THROW(refuse_broken_mesh(mesh), std::invalid_argument);
}

// All 48 numberings of a distorted brick, mirrored ones too, lead to the same one.
TEST(Orientation, AnyNumberingOfABrickIsTurnedToTheBlocksOwn) {
    const Mesh mesh = test::distorted_block({{3, 2, 1}, {1, 1, 1}}, 0.1, 7);
    std::array<int, 3> axis{0, 1, 2};
    int tried = 0;
    do {
        for (int flips = 0; flips < 8; ++flips) {
            Hexahedron turned{};
            for (int a = 0; a < 8; ++a) {
                int to = 0;
                for (int d = 0; d < 3; ++d)
                    to |= (((a >> d) & 1) ^ ((flips >> d) & 1)) << axis[d];
                turned[to] = mesh.elements[0][a];
            }
            EXPECT_EQ(oriented(mesh.nodes, turned), mesh.elements[0]);
            ++tried;
        }
    } while (std::next_permutation(axis.begin(), axis.end()));
    EXPECT_EQ(tried, 48);
}

}  // namespace
}  // namespace magfsi::structure
