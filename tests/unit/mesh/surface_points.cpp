#include "structure/mesh/body_points.h"

#include <gtest/gtest.h>

#include "tests/unit/mesh/meshes.h"

namespace magfsi::structure {
namespace {

const Box box{{3e-3, 1e-3, 0.2e-3}, {6, 3, 2}};

double area(const std::vector<SurfacePoint>& points) {
    double sum = 0;
    for (const SurfacePoint& point : points) sum += point.area_m2;
    return sum;
}

TEST(SurfacePoints, AreasSumToTheSurfaceAtAnySpacing) {
    const Mesh mesh = test::distorted_block(box, 2e-5, 5);
    const auto surface = boundary_quads(mesh);
    double expected = 0;
    for (const SurfaceQuad& quad : surface) expected += quad_area(corners(mesh.nodes, quad.node));
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
    const double volume = test::volume(mesh);
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

}  // namespace
}  // namespace magfsi::structure
