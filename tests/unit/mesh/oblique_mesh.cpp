#include "structure/mesh/block_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "structure/mesh/surface.h"
#include "tests/unit/mesh/meshes.h"

namespace magfsi::structure {
namespace {

ObliquePlate miura() {
    return {4, 3, 5e-3, 6e-3, std::numbers::pi / 3, 1e-3, {5, 6, 2}};
}

TEST(ObliqueMesh, FillsThePlateWithValidElements) {
    const ObliquePlate plate = miura();
    const Mesh mesh = oblique_mesh(plate);  // volume() refuses inverted elements
    const double cell = 5e-3 * 6e-3 * std::sin(std::numbers::pi / 3) * 1e-3;
    EXPECT_NEAR(test::volume(mesh) / (12 * cell), 1, 1e-12);  // rounding of 720 elements
    EXPECT_TRUE(irregular_edges(boundary_quads(mesh)).empty());
}

TEST(ObliqueMesh, CellBordersAreElementBorders) {
    const ObliquePlate plate = miura();
    const Mesh mesh = oblique_mesh(plate);
    ASSERT_EQ(mesh.region.size(), mesh.elements.size());
    ASSERT_EQ(mesh.region_names.size(), 12U);
    EXPECT_EQ(mesh.region_names[7], "row 1 column 3");
    const double lean = std::cos(plate.angle_rad) * plate.length_b_m;
    const double height = std::sin(plate.angle_rad) * plate.length_b_m;
    std::vector<double> volume(12, 0.0);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const int row = mesh.region[e] / 4, column = mesh.region[e] % 4;
        volume[mesh.region[e]] +=
            integrate_hexahedron(gather(mesh.nodes, mesh.elements[e]), 0).volume;
        for (const int node : mesh.elements[e]) {
            const Vec3& x = mesh.nodes[node];
            const double v = x[1] / height - row;  // 0 to 1 in the cell
            const double shift = lean * (row % 2 == 0 ? v : 1 - v);
            const double u = (x[0] - shift) / plate.length_a_m - column;
            for (const double s : {u, v}) {
                EXPECT_GT(s, -1e-12);  // rounding
                EXPECT_LT(s, 1 + 1e-12);
            }
        }
    }
    for (const double v : volume) EXPECT_NEAR(v / volume[0], 1, 1e-12);
}

TEST(ObliqueMesh, FacesAndCentreLineAreNamedAsThoseOfABlock) {
    const Mesh mesh = oblique_mesh(miura());
    EXPECT_EQ(mesh.faces.at("x_min").size(), 19U * 3);
    EXPECT_EQ(mesh.faces.at("y_max").size(), 21U * 3);
    EXPECT_EQ(mesh.faces.at("z_min").size(), 21U * 19);
    ASSERT_EQ(mesh.centre_line.size(), 21U);
    // Half way up row 1: half the lean.
    const Vec3 x = position(mesh, mesh.centre_line.front());
    EXPECT_NEAR(x[0], 1.5e-3, 1e-15);
    EXPECT_NEAR(x[2], 0.5e-3, 1e-15);
}

TEST(ObliqueMesh, WithoutZigzagIsAShearedBlock) {
    ObliquePlate plate = miura();
    plate.zigzag = false;
    const Mesh mesh = oblique_mesh(plate);
    const Vec3& corner = mesh.nodes[20 + 21 * 18];  // i = 20, j = 18, k = 0
    EXPECT_NEAR(corner[0], 4 * 5e-3 + 3 * 3e-3, 1e-15);
}

TEST(ObliqueMesh, ARightAngleGivesABlock) {
    ObliquePlate plate = miura();
    plate.angle_rad = std::numbers::pi / 2;
    const Mesh block = box_mesh({{20e-3, 18e-3, 1e-3}, {20, 18, 2}});
    const Mesh mesh = oblique_mesh(plate);
    ASSERT_EQ(mesh.elements, block.elements);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        EXPECT_LT(test::distance(mesh.nodes[n], block.nodes[n]), 1e-16);  // cos(pi/2)
    }
}

TEST(ObliqueMesh, RefusesWhatIsNotAPlate) {
    for (const double angle : {0.0, std::numbers::pi, -1.0, double(NAN)}) {
        ObliquePlate plate = miura();
        plate.angle_rad = angle;
        EXPECT_THROW(oblique_mesh(plate), std::invalid_argument) << angle;
    }
    ObliquePlate none = miura();
    none.cells[1] = 0;
    EXPECT_THROW(oblique_mesh(none), std::invalid_argument);
    none = miura();
    none.thickness_m = 0;
    EXPECT_THROW(oblique_mesh(none), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
