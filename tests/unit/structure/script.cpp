// The generated script: what is asked for and nothing else.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>

#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/effects/platform/platform_law.h"
#include "structure/lammps/names.h"
#include "structure/lammps/step_limit.h"
#include "structure/lattice/stable_step.h"
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
        body.material = {33e3, 660e3, 1860};
        body.magnetization_a_m = uniform_magnetization(body.mesh, {1e3, 0, 0});
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
    void expect_in_script(const std::vector<std::string>& parts, bool there = true) {
        const std::string lines = text();
        for (const std::string& part : parts)
            EXPECT_EQ(lines.find(part) != std::string::npos, there) << part << " in\n"
                                                                    << lines;
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

TEST_F(Script, OfABareBodyHasNoEffect) {
    expect_in_script({"gravity", "drag", "variable", "field", "clamped", "platform",
                      "contact", "pair", "viscosity", "gradient", "quiet", "every"},
                     false);
    expect_in_script({"fix integrate all nve", "neigh_modify once yes"});
    EXPECT_TRUE(std::filesystem::exists(folder_ / "strip.lattice"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "bodies.data"));
}

TEST_F(Script, EveryEffectBringsItsCommand) {
    Body& body = input_.bodies[0];
    body.clamps = {"x_min"};
    body.material.viscosity_pa_s = 1.5;
    body.element = ElementVariant::assumed_strain;
    input_.field = FieldProgram{{0, 2}, ConstantField{0.01, 1}};
    input_.gradient = GradientInput{{{{1, 0, 0}, {0, 1, 0}, {0, 0, -2}}}, {0, 0, 0.5}};
    input_.gravity_m_s2 = Vec3{0, 0, -9.81};
    input_.drag = Drag{50};
    input_.platform = Platform{{0, 0, -1}, {0, 0, 1}, 2e7, 0.25, 0};
    input_.contact = ContactLaw{2e-4, 3e7, 2};
    input_.quiet = true;
    expect_in_script(
        {"group clamped id 1:26:5", "fix integrate moving nve", "fix gravity all gravity",
         "fix drag all magttice/drag 50", "variable Bx equal f_field[1]",
         "field v_Bx v_By v_Bz",
         "fix platform all magttice/platform 0 0 -1 0 0 1 20000000 friction 0.25",
         "pair_style magttice/contact 0.00020000000000000001 30000000 excluded 2",
         "pair_coeff * *", "compute contact all magttice/contact", " viscosity 1.5",
         " gradient 1 0 0 0 1 0 0 0 -2 0 0 0.5", "element assumed_strain",
         "fix quiet moving magttice/quiet", "neigh_modify every 1 delay 0 check yes"});
    expect_in_script({"once yes"}, false);
}

TEST_F(Script, FillsInWhatIsNotGiven) {
    input_.platform = Platform{};
    input_.contact = ContactLaw{};
    // (lambda + 2 G) / (2 h)
    EXPECT_DOUBLE_EQ(platform_of(input_).stiffness_pa_m, 0.5 * 726e3 / 1e-4);
    const ContactLaw law = contact_law(input_);
    EXPECT_DOUBLE_EQ(law.distance_m, 0.75 * std::hypot(1e-4, 1e-4));
    EXPECT_DOUBLE_EQ(law.stiffness_pa_m, 0.25 * 726e3 / law.distance_m);
}

TEST_F(Script, NumbersBodiesOneAfterTheOther) {
    input_.bodies.push_back(input_.bodies[0]);
    const LammpsScript script = write_lammps_input(input_, folder_);
    EXPECT_EQ(script.first_node, (std::vector<int>{1, 31, 61}));
    EXPECT_EQ(script.fix_id,
              (std::vector<std::string>{"magttice_strip", "magttice_strip_2"}));
}

TEST_F(Script, RefusesBadInputInOneSentence) {
    input_.bodies[0].clamps = {"front"};
    EXPECT_EQ(
        error(),
        "body strip is clamped at front, but its faces are x_max, x_min, y_max, y_min, "
        "z_max, z_min");
    input_.bodies[0].clamps.clear();
    input_.bodies[0].material.density_kg_m3 = -140;
    EXPECT_EQ(error(),
              "body strip has an effective density of -140 kg/m3, it must be positive");
    input_.bodies.clear();
    EXPECT_EQ(error(), "no body found, one is needed");
}

TEST_F(Script, StepLimitFallsByTheSpringsOfASurfaceNode) {
    const Body body = input_.bodies[0];
    EXPECT_DOUBLE_EQ(step_limit_s(body, 0), stable_step_s(body));
    Body viscous = body;
    viscous.material.viscosity_pa_s = 3;
    EXPECT_NEAR(step_limit_s(viscous, 0) / stable_step_s(viscous), 1, 1e-12);
    // A corner of cubes: a node of area sqrt(3) l^2 / 4 and mass rho l^3 / 8.
    const double k = 1e12;
    const double corner = k * (std::sqrt(3.0) / 4) / (1860 * 1e-4 / 8);
    const double own = 2 / stable_step_s(body);
    EXPECT_NEAR(step_limit_s(body, k) / (2 / std::sqrt(own * own + corner)), 1, 1e-12);
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
