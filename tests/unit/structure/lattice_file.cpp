#include "structure/lammps/lattice_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

class LatticeFileTest : public ::testing::Test {
  protected:
    void TearDown() override { std::filesystem::remove(file_); }
    void write(const std::string& text) { std::ofstream(file_) << text; }
    std::string error() {
        try {
            read_lattice_file(file_);
        } catch (const std::runtime_error& cause) {
            return cause.what();
        }
        return "nothing thrown";
    }
    // The test's own name: programs of one build may run side by side.
    std::filesystem::path file_ =
        std::filesystem::temp_directory_path() /
        (std::string("magfsi_lattice_file_") +
         ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(LatticeFileTest, ReadsBackExactly) {
    const Mesh mesh = test::distorted_block({{1e-3, 6e-4, 3e-4}, {3, 2, 1}}, 1e-6, 20);
    LatticeFile out{mesh.nodes, mesh.elements, {}, {}};
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        out.magnetization_a_m.push_back({62e3 / 3, -1.0 / static_cast<double>(e + 1), 0});
    }
    write_lattice_file(out, file_);
    const LatticeFile back = read_lattice_file(file_);
    EXPECT_EQ(back.nodes_m, out.nodes_m);
    EXPECT_EQ(back.elements, out.elements);
    EXPECT_EQ(back.magnetization_a_m, out.magnetization_a_m);
    EXPECT_TRUE(back.element_material.empty());
}

TEST_F(LatticeFileTest, KeepsTheMaterialsOfTheElements) {
    const Mesh mesh = box_mesh({{1e-3, 6e-4, 3e-4}, {3, 1, 1}});
    write_lattice_file({mesh.nodes, mesh.elements, {}, {0, 2, 1}}, file_);
    EXPECT_EQ(read_lattice_file(file_).element_material, (std::vector{0, 2, 1}));
    write("nodes 1\n0 0 0\nelements 1\n0 0 0 0 0 0 0 0 1 2 3 soft\n");
    EXPECT_NE(error().find("number of its material"), std::string::npos);
    write("nodes 1\n0 0 0\nelements 1\n0 0 0 0 0 0 0 0 1 2 3 -1\n");
    EXPECT_NE(error().find("number of its material"), std::string::npos);
}

TEST_F(LatticeFileTest, ErrorsNameTheLineAndWhatItShouldHold) {
    write("# comment\nnodes two\n");
    EXPECT_NE(error().find("line 2: expected \"nodes N\""), std::string::npos);
    write("nodes 1\n0 0\n");
    EXPECT_NE(error().find("line 2: expected three coordinates"), std::string::npos);
    write("nodes 1\n0 0 0\nelements 1\n0 0 0 0 0 0 0 0 1 2\n");
    EXPECT_NE(error().find("line 4: expected eight node numbers"), std::string::npos);
    write("nodes 1\n0 0 0\n");
    EXPECT_NE(error().find("expected \"elements N\""), std::string::npos);
}

TEST_F(LatticeFileTest, AFileThatIsNotThereIsNamed) {
    EXPECT_NE(error().find(file_.string()), std::string::npos);
    EXPECT_THROW(write_lattice_file({}, "/nowhere/strip.lattice"), std::runtime_error);
}

}  // namespace
}  // namespace magfsi::structure
