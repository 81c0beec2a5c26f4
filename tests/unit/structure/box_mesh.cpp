#include "structure/mesh/block_mesh.h"

#include <gtest/gtest.h>

#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const Box box{{3e-3, 1e-3, 0.2e-3}, {6, 3, 2}};

TEST(BoxMesh, ElementsFillTheBox) {
    const Mesh mesh = box_mesh(box);
    EXPECT_EQ(mesh.nodes.size(), 7U * 4 * 3);
    EXPECT_EQ(mesh.elements.size(), 36U);
    double volume = 0;
    for (const Hexahedron& element : mesh.elements) {
        volume += integrate_hexahedron(gather(mesh.nodes, element), 0).volume;
    }
    EXPECT_NEAR(volume / 0.6e-9, 1, 1e-13);  // rounding of 36 volumes
}

TEST(BoxMesh, FacesHoldTheNodesOfTheirPlanes) {
    const Mesh mesh = box_mesh(box);
    ASSERT_EQ(mesh.faces.size(), 6U);
    EXPECT_EQ(mesh.faces.at("x_min").size(), 12U);
    EXPECT_EQ(mesh.faces.at("y_max").size(), 21U);
    EXPECT_EQ(mesh.faces.at("z_max").size(), 28U);
    for (int node : mesh.faces.at("x_max")) EXPECT_DOUBLE_EQ(mesh.nodes[node][0], 3e-3);
    for (int node : mesh.faces.at("z_min")) EXPECT_EQ(mesh.nodes[node][2], 0);
}

TEST(BoxMesh, CentreLineRunsFromLeftToRightAtHalfWidthAndThickness) {
    const Mesh mesh = box_mesh(box);
    ASSERT_EQ(mesh.centre_line.size(), 7U);
    for (std::size_t i = 0; i < 7; ++i) {
        const Vec3 x = position(mesh, mesh.centre_line[i]);
        EXPECT_NEAR(x[0], 0.5e-3 * static_cast<double>(i), 1e-17);
        EXPECT_NEAR(x[1], 0.5e-3, 1e-17);
        EXPECT_NEAR(x[2], 0.1e-3, 1e-17);
    }
}

TEST(BoxMesh, LocateFindsThePointAndItsElement) {
    const Mesh mesh = box_mesh(box);
    test::Random random(15);
    for (int trial = 0; trial < 100; ++trial) {
        Vec3 point{};
        for (int d = 0; d < 3; ++d)
            point[d] = box.size_m[d] * 0.5 * (1 + random.uniform());
        const MaterialPoint found = locate(box, point);
        const Vec3 x = position(mesh, found);
        for (int d = 0; d < 3; ++d)
            EXPECT_NEAR(x[d], point[d], 1e-16);  // rounding of 1e-3
        EXPECT_EQ(mesh.elements[found.element], found.node);
        for (double weight : found.weight) EXPECT_GE(weight, 0);
    }
}

TEST(BoxMesh, PointsOutsideAreDrawnToTheSurface) {
    const Mesh mesh = box_mesh(box);
    const Vec3 x = position(mesh, locate(box, {-1, 0.4e-3, 5}));
    EXPECT_NEAR(x[0], 0, 1e-17);
    EXPECT_NEAR(x[1], 0.4e-3, 1e-17);
    EXPECT_NEAR(x[2], 0.2e-3, 1e-17);
}

TEST(BoxMesh, RefusesAnEmptyBox) {
    EXPECT_THROW(box_mesh({{1, 1, 1}, {1, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(box_mesh({{1, -1, 1}, {1, 1, 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
