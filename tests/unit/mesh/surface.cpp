#include "structure/mesh/surface.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/mesh/meshes.h"

namespace magfsi::structure {
namespace {

const Box box{{3e-3, 1e-3, 0.2e-3}, {6, 3, 2}};
constexpr double box_area_m2 = 2 * (3e-6 + 0.6e-6 + 0.2e-6);

double total(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(Surface, BlockHasItsQuadsAndIsClosed) {
    const auto surface = boundary_quads(box_mesh(box));
    EXPECT_EQ(surface.size(), 2U * (6 * 3 + 6 * 2 + 3 * 2));
    EXPECT_TRUE(irregular_edges(surface).empty());
}

TEST(Surface, QuadsLookOutward) {
    const Mesh mesh = box_mesh(box);
    for (const SurfaceQuad& quad : boundary_quads(mesh)) {
        const Vec3 area = quad_area_vector(corners(mesh.nodes, quad.node));
        const int d = quad.face / 2;
        EXPECT_GT((quad.face % 2 == 1 ? 1 : -1) * area[d], 0);
        // The vector of a plane quad has its area.
        EXPECT_NEAR(std::abs(area[d]) / quad_area(corners(mesh.nodes, quad.node)), 1, 1e-14);
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

TEST(Surface, NodeAreasSumToTheSurface) {
    // Rounding of 72 quads.
    EXPECT_NEAR(total(surface_node_area(box_mesh(box))) / box_area_m2, 1, 1e-14);
    const Mesh distorted = test::distorted_block(box, 2e-5, 3);
    double area = 0;
    for (const SurfaceQuad& quad : boundary_quads(distorted)) {
        area += quad_area(corners(distorted.nodes, quad.node));
    }
    EXPECT_NEAR(total(surface_node_area(distorted)) / area, 1, 1e-14);
}

TEST(Surface, InnerNodesHaveNoArea) {
    const Mesh mesh = box_mesh(box);
    const auto areas = surface_node_area(mesh);
    for (std::size_t n = 0; n < areas.size(); ++n) {
        const Vec3& x = mesh.nodes[n];
        bool inner = true;
        for (int d = 0; d < 3; ++d) {
            // Half a micrometre: far below every element edge.
            inner = inner && x[d] > 5e-7 && x[d] < box.size_m[d] - 5e-7;
        }
        EXPECT_EQ(areas[n] == 0, inner);
    }
}

TEST(Surface, PartsThatMeetInAnEdgeAreReported) {
    Mesh mesh = box_mesh({{2, 2, 1}, {2, 2, 1}});
    mesh.elements = {mesh.elements[0], mesh.elements[3]};  // across the diagonal
    const auto edges = irregular_edges(boundary_quads(mesh));
    ASSERT_EQ(edges.size(), 1U);
    EXPECT_EQ(edges[0], (std::array<int, 2>{4, 13}));  // the middle column of nodes
}

TEST(Surface, AFaceOfThreeElementsIsRefused) {
    Mesh mesh = box_mesh({{2, 1, 1}, {2, 1, 1}});
    mesh.elements.push_back(mesh.elements[0]);
    EXPECT_THROW(boundary_quads(mesh), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
