#include "structure/mesh/block_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "structure/mesh/body_points.h"
#include "structure/mesh/mesh_file.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const Box box{{3e-3, 1e-3, 0.2e-3}, {6, 3, 2}};

TEST(BoxMesh, ElementsFillTheBox) {
    const Mesh mesh = box_mesh(box);
    EXPECT_EQ(mesh.nodes.size(), 7U * 4 * 3);
    EXPECT_EQ(mesh.elements.size(), 36U);
    EXPECT_NEAR(volume_m3(mesh) / 0.6e-9, 1, 1e-13);  // rounding of 36 volumes
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

TEST(BoxMesh, PointsOutsideAreMovedToTheSurface) {
    const Mesh mesh = box_mesh(box);
    const Vec3 x = position(mesh, locate(box, {-1, 0.4e-3, 5}));
    EXPECT_NEAR(x[0], 0, 1e-17);
    EXPECT_NEAR(x[1], 0.4e-3, 1e-17);
    EXPECT_NEAR(x[2], 0.2e-3, 1e-17);
}

ObliquePlate miura() {
    return {4, 3, 5e-3, 6e-3, std::numbers::pi / 3, 1e-3, {5, 6, 2}};
}

TEST(ObliqueMesh, FillsThePlateWithValidElements) {
    const ObliquePlate plate = miura();
    const Mesh mesh = oblique_mesh(plate);  // volume_m3() refuses inverted elements
    const double cell = 5e-3 * 6e-3 * std::sin(std::numbers::pi / 3) * 1e-3;
    EXPECT_NEAR(volume_m3(mesh) / (12 * cell), 1, 1e-12);  // rounding of 720 elements
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

TEST(BlockMesh, RefusesEmptyBoxesAndPlates) {
    EXPECT_THROW(box_mesh({{1, 1, 1}, {1, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(box_mesh({{1, -1, 1}, {1, 1, 1}}), std::invalid_argument);
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

std::filesystem::path scratch(const char* name) {
    return std::filesystem::temp_directory_path() / name;
}

TEST(MeshFile, ReadsBackExactly) {
    Mesh mesh = oblique_mesh({2, 2, 1.0 / 3, 0.7, 1, 0.1, {2, 2, 1}});
    mesh.points["the tip"] = {3};
    mesh.points["centre_line"] = {4, 0, 2, 1, 3};
    const auto file = scratch("magfsi_mesh_file_test.mesh");
    write_mesh_file(mesh, file);
    const Mesh read = read_mesh_file(file);
    EXPECT_EQ(read.nodes, mesh.nodes);
    EXPECT_EQ(read.elements, mesh.elements);
    EXPECT_EQ(read.region, mesh.region);
    EXPECT_EQ(read.region_names, mesh.region_names);
    EXPECT_EQ(read.faces, mesh.faces);
    EXPECT_EQ(read.points, mesh.points);
    ASSERT_EQ(read.centre_line.size(), 5U);
    for (int i = 0; i < 5; ++i) {  // in order of x, whatever the order in the file
        EXPECT_EQ(position(read, read.centre_line[i]), mesh.nodes[i]);
    }
    std::filesystem::remove(file);
}

TEST(MeshFile, ABlockHasNoRegions) {
    const auto file = scratch("magfsi_mesh_file_block.mesh");
    write_mesh_file(box_mesh({{1, 1, 1}, {2, 1, 1}}), file);
    const Mesh read = read_mesh_file(file);
    EXPECT_TRUE(read.region.empty() && read.region_names.empty());
    EXPECT_EQ(read.elements.size(), 2U);
    std::filesystem::remove(file);
}

TEST(MeshFile, ErrorsNameFileLineAndWhatWasExpected) {
    const auto file = scratch("magfsi_mesh_file_wrong.mesh");
    const std::string nodes = "nodes 1\n0 0 0\nregions 0\n";
    const std::pair<std::string, std::string> wrong[] = {
        {"knots 1\n", "line 1: expected \"nodes N\""},
        {"nodes 1\n0 0\n", "line 2: expected three coordinates"},
        {nodes + "elements 1\n0 0 0 0 0 0 0 1 -1\n", "line 5: expected numbers of nodes"},
        {nodes + "elements 1\n0 0 0 0 0 0 0 0 0\n", "line 5: expected eight node"},
        {nodes, "line 3: expected \"elements N\""},
        {nodes + "elements 0\nfaces 1\nmany top\n", "line 6: expected the count"}};
    for (const auto& [text, expected] : wrong) {
        std::ofstream(file) << text;
        try {
            read_mesh_file(file);
            ADD_FAILURE() << "read: " << text;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(file.string() + ", " + expected),
                      std::string::npos)
                << error.what();
        }
    }
    std::filesystem::remove(file);
    EXPECT_THROW(read_mesh_file(file), std::runtime_error);
}

}  // namespace
}  // namespace magfsi::structure
