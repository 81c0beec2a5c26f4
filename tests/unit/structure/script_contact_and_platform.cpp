#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>

#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/effects/platform/platform_law.h"
#include "structure/lammps/script.h"
#include "structure/lammps/step_limit.h"
#include "structure/lattice/stable_step.h"
#include "structure/magnetics/magnetization.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

LammpsInput sheet() {
    Body body;
    body.name = "strip";
    body.mesh = box_mesh({{4e-4, 2e-4, 1e-4}, {4, 2, 1}});
    body.material = {33e3, 660e3, 1860};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {1e3, 0, 0});
    LammpsInput input;
    input.bodies = {body};
    input.time_step_s = 1e-7;
    return input;
}

std::string script_of(const LammpsInput& input) {
    std::string folder = std::filesystem::temp_directory_path() / "magfsi.XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    std::string out;
    for (const auto& line : write_lammps_input(input, folder).setup) out += line + "\n";
    std::filesystem::remove_all(folder);
    return out;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(ScriptEffects, AreAbsentWhereNobodyAsks) {
    const std::string lines = script_of(sheet());
    for (const char* absent :
         {"platform", "contact", "pair", "viscosity", "gradient", "quiet", "every"}) {
        EXPECT_FALSE(has(lines, absent)) << absent;
    }
    EXPECT_TRUE(has(lines, "neigh_modify once yes"));
}

TEST(ScriptEffects, BringTheirCommands) {
    LammpsInput input = sheet();
    input.platform = Platform{{0, 0, -1}, {0, 0, 1}, 2e7, 0.25, 0};
    input.contact = ContactLaw{2e-4, 3e7, 2};
    input.bodies[0].material.viscosity_pa_s = 1.5;
    input.gradient = GradientInput{{{{1, 0, 0}, {0, 1, 0}, {0, 0, -2}}}, {0, 0, 0.5}};
    input.quiet = true;
    input.bodies[0].element = ElementVariant::assumed_strain;
    const std::string lines = script_of(input);
    for (const char* present :
         {"fix platform all magttice/platform 0 0 -1 0 0 1 20000000 friction 0.25",
          "pair_style magttice/contact 0.00020000000000000001 30000000 excluded 2",
          "pair_coeff * *", "compute contact all magttice/contact", " viscosity 1.5",
          " gradient 1 0 0 0 1 0 0 0 -2 0 0 0.5", "element assumed_strain",
          "fix quiet all magttice/quiet", "neigh_modify every 1 delay 0 check yes"}) {
        EXPECT_TRUE(has(lines, present)) << present << " in\n" << lines;
    }
    EXPECT_FALSE(has(lines, "once yes"));
}

TEST(ScriptEffects, FillInWhatIsNotGiven) {
    LammpsInput input = sheet();
    input.platform = Platform{};
    input.contact = ContactLaw{};
    // (lambda + 2 G) / (2 h)
    EXPECT_DOUBLE_EQ(platform_of(input).stiffness_pa_m, 0.5 * 726e3 / 1e-4);
    const ContactLaw law = contact_law(input);
    EXPECT_DOUBLE_EQ(law.distance_m, 0.75 * std::hypot(1e-4, 1e-4));
    EXPECT_DOUBLE_EQ(law.stiffness_pa_m, 0.25 * 726e3 / law.distance_m);
}

TEST(StepLimit, FallsByTheSpringsOfASurfaceNode) {
    const Body body = sheet().bodies[0];
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

}  // namespace
}  // namespace magfsi::structure
