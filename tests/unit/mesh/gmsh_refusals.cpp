#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "structure/mesh/gmsh_mesh.h"
#include "tests/unit/mesh/gmsh_files.h"
#include "tests/unit/mesh/meshes.h"

namespace magfsi::structure {
namespace {

// What the error says; it must name the file, and the test fails where there is none.
std::string refusal(const std::filesystem::path& file) {
    try {
        read_gmsh_mesh(file, 1);
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos);
        return error.what();
    }
    ADD_FAILURE() << file << " was not refused";
    return "";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        EXPECT_NE(text.find(word), std::string::npos)
            << "\"" << word << "\" in: " << text;
    }
}

void cube() {
    test::add_block(0, 0, 0, 1, 1, 1, 2, 2, 2);
    gmsh::model::geo::synchronize();
}

// One cube in version 2.2: the corners' numbers in Gmsh's order.
std::string one_cube(const std::string& corners) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n"
           "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
           "$EndNodes\n$Elements\n1\n1 5 2 0 1 " +
           corners + "\n$EndElements\n";
}

TEST(GmshRefusals, Tetrahedra) {
    const auto file = test::gmsh_file("tets.msh", {}, [] {
        gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
        gmsh::model::occ::synchronize();
    });
    expect_words(refusal(file), {"Tetrahedron 4", "hexahedra of 8 nodes", "Recombine"});
}

TEST(GmshRefusals, SecondOrder) {
    const auto file = test::gmsh_file("second.msh", {}, [] {
        gmsh::option::setNumber("Mesh.ElementOrder", 2);
        cube();
    });
    expect_words(refusal(file), {"Hexahedron 27", "Mesh.ElementOrder = 1"});
}

TEST(GmshRefusals, SurfaceOnly) {
    const auto file = test::gmsh_file("surface.msh", {}, cube, 2);
    expect_words(refusal(file), {"(none) found", "mesh in 3D"});
}

TEST(GmshRefusals, PartsThatTouchWithoutBeingJoined) {
    const auto file = test::gmsh_file("touch.msh", {}, [] {
        gmsh::option::setNumber("Geometry.AutoCoherence", 0);
        cube();
        test::add_block(1, 0, 0, 1, 1, 1, 2, 2, 2);
        gmsh::model::geo::synchronize();
    });
    expect_words(refusal(file), {"coincide at (1, ", "Coherence"});
}

TEST(GmshRefusals, AVolumeInTwoGroups) {
    const auto file = test::gmsh_file("twice.msh", {}, [] {
        const int volume = test::add_block(0, 0, 0, 1, 1, 1, 2, 2, 2).volume;
        gmsh::model::geo::synchronize();
        for (const char* name : {"all", "left"}) {
            gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {volume}),
                                         name);
        }
    });
    expect_words(refusal(file), {"\"all\"", "\"left\"", "it may be in one"});
}

TEST(GmshRefusals, AFaceAwayFromTheBody) {
    const auto file = test::gmsh_file("away.msh", {}, [] {
        const int volume = test::add_block(0, 0, 0, 1, 1, 1, 2, 2, 2).volume;
        const int away = gmsh::model::geo::addPoint(5, 5, 5);
        gmsh::model::geo::synchronize();
        gmsh::model::addPhysicalGroup(3, {volume});
        gmsh::model::setPhysicalName(0, gmsh::model::addPhysicalGroup(0, {away}), "far");
    });
    expect_words(refusal(file), {"\"far\" has no node of a hexahedron"});
}

TEST(GmshRefusals, AnInsideOutElement) {
    expect_words(refusal(test::text_file("bowtie.msh", one_cube("1 2 3 4 6 5 7 8"))),
                 {"element 0", "inverted or flat"});
}

TEST(GmshRefusals, AMirroredElementIsTurnedInstead) {
    const auto file = test::text_file("mirrored.msh", one_cube("5 6 7 8 1 2 3 4"));
    const Mesh mesh = read_gmsh_mesh(file, 1).mesh;
    EXPECT_EQ(mesh.elements.at(0), (Hexahedron{0, 1, 3, 2, 4, 5, 7, 6}));
    EXPECT_NEAR(test::volume(mesh), 1, 1e-15);
}

TEST(GmshRefusals, OtherFilesAndVersions) {
    expect_words(refusal(test::text_file("a.geo", "Point(1) = {0, 0, 0};\n")),
                 {"$MeshFormat"});
    expect_words(refusal(test::text_file("old.msh", "$MeshFormat\n4 0 8\n")),
                 {"version 4 of", "2.2 and 4.1"});
    expect_words(refusal(test::file_in_folder("absent.msh")), {"cannot be opened"});
}

TEST(GmshRefusals, AFileCutOffAtAnyPlace) {
    for (const bool binary : {false, true}) {
        const auto whole = test::gmsh_file("whole.msh", {4.1, binary}, cube);
        std::ifstream stream(whole, std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(stream)), {});
        for (const double share : {0.02, 0.3, 0.5, 0.7, 0.9}) {
            const auto size = static_cast<std::size_t>(share * double(text.size()));
            const auto cut = test::text_file("cut.msh", text.substr(0, size));
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
