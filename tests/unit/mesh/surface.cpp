// The surface of a mesh, and points spread over it and through the body.
#include "structure/mesh/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "structure/mesh/body_points.h"
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
        const Vec3 area = quad_area_vector(corners(mesh.nodes, quad.node));
        for (int d = 0; d < 3; ++d) sum[d] += area[d];
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
            for (int d = 0; d < 3; ++d) flux += x[d] * p.normal[d] * p.area_m2;
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

}  // namespace
}  // namespace magfsi::structure
