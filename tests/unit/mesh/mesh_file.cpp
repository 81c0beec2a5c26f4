#include "structure/mesh/mesh_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "structure/mesh/block_mesh.h"
#include "tests/unit/mesh/meshes.h"

namespace magfsi::structure {
namespace {

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
