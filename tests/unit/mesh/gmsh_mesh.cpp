// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes that Gmsh itself makes and saves, read back.
#include "structure/mesh/gmsh_mesh.h"

#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "structure/mesh/block_mesh.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"
#include "tests/support/checks.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

struct Format {
    double version = 4.1;
    bool binary = false;
};

std::filesystem::path file_in_folder(const std::string& name) {
    const auto folder = std::filesystem::temp_directory_path() / "magfsi_gmsh_tests";
    std::filesystem::create_directories(folder);
    return folder / name;
}

// Runs `build` in an empty model of Gmsh, meshes and saves it.
std::filesystem::path gmsh_file(const std::string& name, const Format& format,
                                const std::function<void()>& build, int dimension = 3) {
    const auto file = file_in_folder(name);
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("Mesh.MshFileVersion", format.version);
    gmsh::option::setNumber("Mesh.Binary", format.binary ? 1 : 0);
    build();
    gmsh::model::mesh::generate(dimension);
    gmsh::write(file.string());
    gmsh::finalize();
    return file;
}

// Block of hexahedra by extrusion, sizes in the mesh's unit. Returns the volume's tag;
// gives the tags of its top and of its point at (x, y, 0).
struct Block {
    int volume = 0, top = 0, bottom = 0, corner = 0;
};
Block add_block(double x, double y, double z, double lx, double ly, double lz, int nx,
                int ny, int nz) {
    const int p0 = gmsh::model::geo::addPoint(x, y, z);
    const int p1 = gmsh::model::geo::addPoint(x + lx, y, z);
    const int l = gmsh::model::geo::addLine(p0, p1);
    gmsh::model::geo::mesh::setTransfiniteCurve(l, nx + 1);
    gmsh::vectorpair face, body;
    gmsh::model::geo::extrude({{1, l}}, 0, ly, 0, face, {ny}, {}, true);
    gmsh::model::geo::extrude({face[1]}, 0, 0, lz, body, {nz}, {}, true);
    return {body[1].second, body[0].second, face[1].second, p0};
}

std::filesystem::path text_file(const std::string& name, const std::string& text) {
    const auto file = file_in_folder(name);
    std::ofstream(file) << text;
    return file;
}

// 3 x 1 x 0.2 mm in millimetres, two volumes side by side, with names.
void named_block() {
    const Block left = add_block(0, 0, 0, 1, 1, 0.2, 2, 3, 2);
    const Block right = add_block(1, 0, 0, 2, 1, 0.2, 4, 3, 2);
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

class EveryFormat : public testing::TestWithParam<Format> {};

TEST_P(EveryFormat, GivesTheBlockWithItsNames) {
    const auto file = gmsh_file("named.msh", GetParam(), named_block);
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
        for (const int n : mesh.elements[e]) centre += 0.125 * mesh.nodes[n];
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
                         testing::Values(Format{2.2, false}, Format{2.2, true},
                                         Format{4.1, false}, Format{4.1, true}));

TEST(GmshMesh, WithoutGroupsIsOnePieceWithoutRegions) {
    const auto file = gmsh_file("plain.msh", {}, [] {
        add_block(0, 0, 0, 1, 1, 1, 2, 2, 2);
        gmsh::model::geo::synchronize();
    });
    const Mesh mesh = read_gmsh_mesh(file, 1).mesh;
    EXPECT_EQ(mesh.elements.size(), 8U);
    EXPECT_TRUE(mesh.region.empty() && mesh.region_names.empty() && mesh.faces.empty());
}

TEST(GmshMesh, NodesOfNoHexahedronAreDroppedAndPartsCounted) {
    const auto file = gmsh_file("parts.msh", {}, [] {
        add_block(0, 0, 0, 1, 1, 1, 2, 2, 2);
        add_block(2, 0, 0, 1, 1, 1, 3, 1, 1);
        gmsh::model::geo::addPoint(5, 5, 5);
        gmsh::model::geo::synchronize();
    });
    const GmshMesh read = read_gmsh_mesh(file, 1);
    EXPECT_EQ(read.part_elements, (std::vector<int>{8, 3}));
    EXPECT_EQ(read.unused_nodes, 1);
    EXPECT_EQ(read.mesh.nodes.size(), 27U + 16U);
}

TEST(GmshMesh, TheCurveCentreLineBecomesTheCentreLine) {
    const auto file = gmsh_file("line.msh", {}, [] {
        const auto lower = add_block(0, 0, 0, 3, 1, 1, 3, 1, 1);
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

// What the error says; it must name the file, and the test fails where there is none.
std::string refusal(const std::filesystem::path& file) {
    const auto text =
        test::message_of<std::runtime_error>([&] { read_gmsh_mesh(file, 1); });
    test::expect_says(text, {file.string()});
    return text;
}

void cube() {
    add_block(0, 0, 0, 1, 1, 1, 2, 2, 2);
    gmsh::model::geo::synchronize();
}

// One cube in version 2.2: the corners' numbers in Gmsh's order; those of the last node
// and of the element.
std::string one_cube(const std::string& corners, const std::string& node = "8",
                     const std::string& element = "1") {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n"
           "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n" +
           node + " 0 1 1\n$EndNodes\n$Elements\n1\n" + element + " 5 2 0 1 " + corners +
           "\n$EndElements\n";
}

TEST(GmshRefusals, Tetrahedra) {
    const auto file = gmsh_file("tets.msh", {}, [] {
        gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
        gmsh::model::occ::synchronize();
    });
    test::expect_says(refusal(file),
                      {"Tetrahedron 4", "hexahedra of 8 nodes", "Recombine"});
}

TEST(GmshRefusals, CommandsBesideTheMesh) {
    const auto file = gmsh_file("options.msh", {}, cube);
    const std::filesystem::path options = file.string() + ".opt", made = "commands_ran";
    std::ofstream(options) << "SystemCall \"touch commands_ran\";\n";
    test::expect_says(refusal(file), {"options.msh.opt", "remove it"});
    EXPECT_FALSE(std::filesystem::exists(made));
    std::filesystem::remove(options);
}

TEST(GmshRefusals, SecondOrder) {
    const auto file = gmsh_file("second.msh", {}, [] {
        gmsh::option::setNumber("Mesh.ElementOrder", 2);
        cube();
    });
    test::expect_says(refusal(file), {"Hexahedron 27", "Mesh.ElementOrder = 1"});
}

TEST(GmshRefusals, SurfaceOnly) {
    const auto file = gmsh_file("surface.msh", {}, cube, 2);
    test::expect_says(refusal(file), {"(none) found", "mesh in 3D"});
}

TEST(GmshRefusals, PartsThatTouchWithoutBeingJoined) {
    const auto file = gmsh_file("touch.msh", {}, [] {
        gmsh::option::setNumber("Geometry.AutoCoherence", 0);
        cube();
        add_block(1, 0, 0, 1, 1, 1, 2, 2, 2);
        gmsh::model::geo::synchronize();
    });
    test::expect_says(refusal(file), {"coincide at (1, ", "Coherence"});
}

TEST(GmshRefusals, AVolumeInTwoGroups) {
    const auto file = gmsh_file("twice.msh", {}, [] {
        const int volume = add_block(0, 0, 0, 1, 1, 1, 2, 2, 2).volume;
        gmsh::model::geo::synchronize();
        for (const char* name : {"all", "left"}) {
            gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {volume}),
                                         name);
        }
    });
    test::expect_says(refusal(file), {"\"all\"", "\"left\"", "it may be in one"});
}

TEST(GmshRefusals, AFaceAwayFromTheBody) {
    const auto file = gmsh_file("away.msh", {}, [] {
        const int volume = add_block(0, 0, 0, 1, 1, 1, 2, 2, 2).volume;
        const int away = gmsh::model::geo::addPoint(5, 5, 5);
        gmsh::model::geo::synchronize();
        gmsh::model::addPhysicalGroup(3, {volume});
        gmsh::model::setPhysicalName(0, gmsh::model::addPhysicalGroup(0, {away}), "far");
    });
    test::expect_says(refusal(file), {"\"far\" has no node of a hexahedron"});
}

TEST(GmshRefusals, AnInsideOutElement) {
    test::expect_says(refusal(text_file("bowtie.msh", one_cube("1 2 3 4 6 5 7 8"))),
                      {"element 1 of the mesh", "inverted or flat"});
}

TEST(GmshRefusals, NameElementsByTheNumbersOfTheFile) {
    test::expect_says(
        refusal(text_file("number.msh", one_cube("1 2 3 4 6 5 7 8", "8", "41"))),
        {"element 41 of the mesh"});
    std::string twins = one_cube("1 2 3 4 5 6 7 8", "8", "41");
    twins.replace(twins.find("$Elements\n1"), 11, "$Elements\n2");
    twins.insert(twins.find("$EndElements"), "57 5 2 0 1 5 6 7 8 1 2 3 4\n");
    test::expect_says(refusal(text_file("twins.msh", twins)), {"elements 41 and 57"});
}

TEST(GmshRefusals, NumbersAbove31Bits) {
    const std::string most = "2147483647";
    for (const std::string more : {"2147483648", "4294967304", "99999999999999999999"}) {
        for (const bool of_node : {true, false}) {
            const auto cube = [&](const std::string& number) {
                return text_file(
                    "large.msh",
                    one_cube("1 2 3 4 5 6 7 " + (of_node ? number : "8"),
                             of_node ? number : "8", of_node ? "1" : number));
            };
            test::expect_says(refusal(cube(more)), {more, most, "Mesh.Renumber"});
            EXPECT_EQ(read_gmsh_mesh(cube(most), 1).mesh.elements.size(), 1U);
        }
    }
}

// The fuzzer's, too.
TEST(GmshRefusals, SectionsThatDoNotHoldWhatTheyAnnounce) {
    const auto with = [](const std::string& what, const std::string& instead) {
        std::string text = one_cube("1 2 3 4 5 6 7 8");
        text.replace(text.find(what), what.size(), instead);
        return refusal(text_file("sections.msh", text));
    };
    test::expect_says(with("$Nodes\n8", "$Nodes\n9"),
                      {"line 14: too few rows in $Nodes"});
    test::expect_says(with("$Nodes\n8", "$Nodes\n7"),
                      {"line 13: too many rows in $Nodes"});
    test::expect_says(with("$Elements\n1", "$Elements\n2"),
                      {"too few rows in $Elements"});
    test::expect_says(with("$Elements\n1", "$Elements~\n2"),
                      {"too few rows in $Elements"});
    test::expect_says(with("7 8\n$EndE", "7 9\n$EndE"),
                      {"line 17: node 9, which is not"});
    test::expect_says(with("$EndNodes", "$Nodes"),
                      {"line 14: a second section in $Nodes"});
}

// The fuzzer's: an element with a node too few took it from the next line, and the
// library crashed a line later.
TEST(GmshRefusals, LinesWithOtherNumbersThanTheirElementHas) {
    const auto with = [](const std::string& line) {
        std::string text = one_cube("1 2 3 4 5 6 7 8");
        text.replace(text.find("$Elements\n1"), 11, "$Elements\n2");
        text.insert(text.find("$EndElements"), line + "\n");
        return text_file("line.msh", text);
    };
    test::expect_says(refusal(with("7 3 3 2 1 1 4 8 5")),
                      {"line 18: 6 tags and nodes found", "3 tags and 4 nodes belong"});
    test::expect_says(refusal(with("7 3 3 2 1 1 4 8 5 1")),
                      {"1 partitions announced in 3 tags"});
    test::expect_says(refusal(with("7 3")), {"2 numbers found"});
    test::expect_says(refusal(with("7 999 0 1")), {"kind 999 found"});
    test::expect_says(refusal(with("7 3 -1 4 8 5")), {"-1 tags"});
    EXPECT_NO_THROW((void)read_gmsh_mesh(with("7 3 2 0 1 1 2 3 4"), 1));
}

TEST(GmshRefusals, AMirroredElementIsTurnedInstead) {
    const auto file = text_file("mirrored.msh", one_cube("5 6 7 8 1 2 3 4"));
    const Mesh mesh = read_gmsh_mesh(file, 1).mesh;
    EXPECT_EQ(mesh.elements.at(0), (Hexahedron{0, 1, 3, 2, 4, 5, 7, 6}));
    EXPECT_NEAR(volume_m3(mesh), 1, 1e-15);
}

TEST(GmshRefusals, OtherFilesAndVersions) {
    test::expect_says(refusal(text_file("a.geo", "Point(1) = {0, 0, 0};\n")),
                      {"$MeshFormat"});
    test::expect_says(refusal(text_file("old.msh", "$MeshFormat\n4 0 8\n")),
                      {"version 4 of", "2.2 and 4.1"});
    test::expect_says(refusal(file_in_folder("absent.msh")), {"cannot be opened"});
}

TEST(GmshRefusals, AFileCutOffAtAnyPlace) {
    for (const bool binary : {false, true}) {
        const auto whole = gmsh_file("whole.msh", {4.1, binary}, cube);
        std::ifstream stream(whole, std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(stream)), {});
        for (const double share : {0.02, 0.3, 0.5, 0.7, 0.9}) {
            const auto size = static_cast<std::size_t>(share * double(text.size()));
            const auto cut = text_file("cut.msh", text.substr(0, size));
            SCOPED_TRACE(share);
            EXPECT_NE(refusal(cut), "");
        }
    }
}

TEST(GmshRefusals, AUnitOfNoLength) {
    EXPECT_THROW(read_gmsh_mesh("any.msh", 0), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
