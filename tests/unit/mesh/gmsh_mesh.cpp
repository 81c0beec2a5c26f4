#include "structure/mesh/gmsh_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "structure/mesh/locate.h"
#include "tests/unit/mesh/gmsh_files.h"
#include "tests/unit/mesh/meshes.h"

namespace magfsi::structure {
namespace {

// 3 x 1 x 0.2 mm in millimetres, two volumes side by side, with names.
void named_block() {
    const test::Block left = test::add_block(0, 0, 0, 1, 1, 0.2, 2, 3, 2);
    const test::Block right = test::add_block(1, 0, 0, 2, 1, 0.2, 4, 3, 2);
    gmsh::model::geo::removeAllDuplicates();
    gmsh::model::geo::synchronize();
    const auto name = [](int dimension, std::vector<int> tags, const char* text) {
        const int group = gmsh::model::addPhysicalGroup(dimension, tags);
        gmsh::model::setPhysicalName(dimension, group, text);
    };
    name(3, {left.volume}, "soft part");
    name(3, {right.volume}, "stiff");
    name(2, {left.top, right.top}, "top");
    name(0, {left.corner}, "tip");
}

class EveryFormat : public testing::TestWithParam<test::Format> {};

TEST_P(EveryFormat, GivesTheBlockWithItsNames) {
    const auto file = test::gmsh_file("named.msh", GetParam(), named_block);
    const GmshMesh read = read_gmsh_mesh(file, 1e-3);
    const Mesh& mesh = read.mesh;
    const Mesh block = box_mesh({{3e-3, 1e-3, 0.2e-3}, {6, 3, 2}});
    ASSERT_EQ(mesh.elements.size(), block.elements.size());
    ASSERT_EQ(mesh.nodes.size(), block.nodes.size());
    EXPECT_EQ(read.part_elements, std::vector<int>{36});
    EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"soft part", "stiff"}));
    const PointLocator locator(block);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        Vec3 centre{};
        for (const int n : mesh.elements[e]) {
            for (int d = 0; d < 3; ++d) centre[d] += 0.125 * mesh.nodes[n][d];
        }
        const int same = locator.nearest(centre).element;
        for (int a = 0; a < 8; ++a) {
            // Gmsh merges points within 1e-8 of the model and writes 16 digits.
            EXPECT_LT(test::distance(mesh.nodes[mesh.elements[e][a]],
                                     block.nodes[block.elements[same][a]]),
                      1e-10);
        }
        EXPECT_EQ(mesh.region_names[mesh.region[e]],
                  centre[0] < 1e-3 ? "soft part" : "stiff");
    }
    ASSERT_EQ(mesh.faces.at("top").size(), 28U);
    for (const int node : mesh.faces.at("top")) {
        EXPECT_NEAR(mesh.nodes[node][2], 0.2e-3, 1e-12);
    }
    ASSERT_EQ(mesh.points.at("tip").size(), 1U);
    EXPECT_LT(test::distance(mesh.nodes[mesh.points.at("tip")[0]], {0, 0, 0}), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Gmsh, EveryFormat,
                         testing::Values(test::Format{2.2, false},
                                         test::Format{2.2, true},
                                         test::Format{4.1, false},
                                         test::Format{4.1, true}));

TEST(GmshMesh, WithoutGroupsIsOnePieceWithoutRegions) {
    const auto file = test::gmsh_file("plain.msh", {}, [] {
        test::add_block(0, 0, 0, 1, 1, 1, 2, 2, 2);
        gmsh::model::geo::synchronize();
    });
    const Mesh mesh = read_gmsh_mesh(file, 1).mesh;
    EXPECT_EQ(mesh.elements.size(), 8U);
    EXPECT_TRUE(mesh.region.empty() && mesh.region_names.empty() && mesh.faces.empty());
}

TEST(GmshMesh, NodesOfNoHexahedronAreDroppedAndPartsCounted) {
    const auto file = test::gmsh_file("parts.msh", {}, [] {
        test::add_block(0, 0, 0, 1, 1, 1, 2, 2, 2);
        test::add_block(2, 0, 0, 1, 1, 1, 3, 1, 1);
        gmsh::model::geo::addPoint(5, 5, 5);
        gmsh::model::geo::synchronize();
    });
    const GmshMesh read = read_gmsh_mesh(file, 1);
    EXPECT_EQ(read.part_elements, (std::vector<int>{8, 3}));
    EXPECT_EQ(read.unused_nodes, 1);
    EXPECT_EQ(read.mesh.nodes.size(), 27U + 16U);
}

TEST(GmshMesh, TheCurveCentreLineBecomesTheCentreLine) {
    const auto file = test::gmsh_file("line.msh", {}, [] {
        const auto lower = test::add_block(0, 0, 0, 3, 1, 1, 3, 1, 1);
        gmsh::model::geo::synchronize();
        gmsh::vectorpair curves;
        gmsh::model::getBoundary({{2, lower.bottom}}, curves, false, false);
        gmsh::model::addPhysicalGroup(3, {lower.volume});
        const int line = gmsh::model::addPhysicalGroup(1, {curves[0].second});
        gmsh::model::setPhysicalName(1, line, "centre_line");
    });
    const Mesh mesh = read_gmsh_mesh(file, 1).mesh;
    ASSERT_EQ(mesh.centre_line.size(), 4U);
    for (int i = 0; i < 4; ++i) {
        // Gmsh finds equal lengths along a curve to about 1e-11.
        EXPECT_NEAR(position(mesh, mesh.centre_line[i])[0], i, 1e-10);
    }
    EXPECT_EQ(mesh.region_names, std::vector<std::string>{"1"});  // no name: its number
}

}  // namespace
}  // namespace magfsi::structure
