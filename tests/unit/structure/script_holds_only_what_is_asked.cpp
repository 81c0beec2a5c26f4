#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>

#include "structure/lammps/names.h"
#include "structure/lammps/script.h"
#include "structure/magnetics/magnetization.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

class Script : public ::testing::Test {
  protected:
    Script() {
        std::string name = std::filesystem::temp_directory_path() / "magfsi.XXXXXX";
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
        folder_ = name;
        Body body;
        body.name = "strip";
        body.mesh = box_mesh({{4e-4, 2e-4, 1e-4}, {4, 2, 1}});
        body.material = test::soft_material();
        input_.bodies = {body};
        input_.time_step_s = 1e-7;
    }
    ~Script() override { std::filesystem::remove_all(folder_); }
    std::string text() {
        std::string out;
        for (const auto& line : write_lammps_input(input_, folder_).setup)
            out += line + "\n";
        return out;
    }
    std::string error() {
        try {
            write_lammps_input(input_, folder_);
        } catch (const std::exception& cause) {
            return cause.what();
        }
        return "nothing thrown";
    }
    std::filesystem::path folder_;
    LammpsInput input_;
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(Script, ABareBodyNeedsNoLoadsNoFieldAndNoClamps) {
    const std::string lines = text();
    for (const char* absent : {"gravity", "drag", "variable", "field", "clamped"}) {
        EXPECT_FALSE(has(lines, absent)) << absent;
    }
    EXPECT_TRUE(has(lines, "fix integrate all nve"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "strip.lattice"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "bodies.data"));
}

TEST_F(Script, EveryEffectBringsItsCommand) {
    input_.bodies[0].clamps = {"x_min"};
    input_.bodies[0].magnetization_a_m =
        uniform_magnetization(input_.bodies[0].mesh, {1e3, 0, 0});
    input_.field = FieldProgram{{0, 2}, ConstantField{0.01, 1}};
    input_.gravity_m_s2 = Vec3{0, 0, -9.81};
    input_.drag_rate_1_s = 50;
    const std::string lines = text();
    for (const char* present :
         {"group clamped id 1:26:5", "fix integrate moving nve",
          "fix gravity all gravity", "fix drag all magttice/drag 50",
          "variable Bx equal f_field[1]", "field v_Bx v_By v_Bz"}) {
        EXPECT_TRUE(has(lines, present)) << present << " in\n" << lines;
    }
}

TEST_F(Script, BodiesAreNumberedOneAfterTheOther) {
    input_.bodies.push_back(input_.bodies[0]);
    const LammpsScript script = write_lammps_input(input_, folder_);
    EXPECT_EQ(script.first_node, (std::vector<int>{1, 31, 61}));
    EXPECT_EQ(script.fix_id,
              (std::vector<std::string>{"magttice_strip", "magttice_strip_2"}));
}

TEST_F(Script, BadInputIsRefusedInOneSentence) {
    input_.bodies[0].clamps = {"front"};
    EXPECT_EQ(error(),
              "body strip is clamped at front, but its faces are x_max, x_min, y_max, "
              "y_min, z_max, z_min");
    input_.bodies[0].clamps.clear();
    input_.bodies[0].material.density_kg_m3 = -140;
    EXPECT_EQ(error(),
              "body strip has an effective density of -140 kg/m3, it must be positive");
    input_.bodies.clear();
    EXPECT_EQ(error(), "no body found, one is needed");
}

TEST(Names, AreFitForLammps) {
    std::vector<Body> bodies(4);
    bodies[0].name = "left arm-1";
    bodies[1].name = "left_arm_1";
    bodies[2].name = "all";
    EXPECT_EQ(lammps_names(bodies),
              (std::vector<std::string>{"left_arm_1", "left_arm_1_2", "all_2", "body"}));
    EXPECT_EQ(id_ranges({1, 5, 9, 13, 14, 20}), "1:13:4 14 20");
    EXPECT_THROW(quoted("a$b"), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
