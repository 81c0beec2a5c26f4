// SPDX-License-Identifier: GPL-2.0-or-later
// The generated script: what is asked for and nothing else.
#include <gtest/gtest.h>
#include <stdlib.h>
#include <cmath>
#include <numbers>
#include "structure/equilibrium/newton.h"
#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/field_program.h"
#include "structure/lammps/names.h"
#include "structure/lammps/placement.h"
#include "structure/lammps/platform_law.h"
#include "structure/lattice/stable_step.h"
#include "structure/magnetics/magnetization.h"
#include "structure/table_rows.h"
#include "tests/support/checks.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

class Script : public ::testing::Test {
  protected:
    Script() {
        Body body;
        body.name = "strip";
        body.mesh = box_mesh({{4e-4, 2e-4, 1e-4}, {4, 2, 1}});
        body.material = {33e3, 660e3, 1860};
        body.magnetization_a_m = uniform_magnetization(body.mesh, {1e3, 0, 0});
        input_.bodies = {body};
        input_.time_step_s = 1e-7;
    }

    std::string text() {
        std::string out;
        for (const auto& line : write_lammps_input(input_, folder_.path()).setup)
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
        return test::message_of([&] { write_lammps_input(input_, folder_.path()); });
    }
    test::TemporaryFolder folder_;
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
         "fix quiet moving magttice/quiet", "neigh_modify once yes"});
}

TEST_F(Script, FillsInWhatIsNotGiven) {
    input_.platform = Platform{};
    input_.contact = ContactLaw{};
    // (lambda + 2 G) / (2 h)
    EXPECT_DOUBLE_EQ(with_stiffness(*input_.platform, input_.bodies).stiffness_pa_m,
                     0.5 * 726e3 / 1e-4);
    const ContactLaw law = contact_law(input_);
    EXPECT_DOUBLE_EQ(law.distance_m, 0.75 * std::hypot(1e-4, 1e-4));
    EXPECT_DOUBLE_EQ(law.stiffness_pa_m, 0.25 * 726e3 / law.distance_m);
}

TEST_F(Script, NumbersBodiesOneAfterTheOther) {
    input_.bodies.push_back(input_.bodies[0]);
    const LammpsScript script = write_lammps_input(input_, folder_.path());
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
              "body strip has an effective density of -140 kg/m3, it must be positive: "
              "take a larger density of the material");
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
    EXPECT_EQ(path_in_script("/a b"), "\"/a b\"");
    EXPECT_EQ(path_in_script("/a$b"), "/a%24b");
}

constexpr double pi = std::numbers::pi;
constexpr double roundoff = 1e-17;  // of fields of 0.02 T

FieldProgram strokes() {
    return {
        {0, 2},
        FieldTable{{0, 0.02, 0.03, 0.04}, {-0.017, 0.017, -0.017, -0.017}, {0.3}, true}};
}

void expect_polar(const FieldProgram& program, double t, double magnitude, double angle) {
    const Vec3 b = field_at(program, t);
    EXPECT_NEAR(b[program.plane[0]], magnitude * std::cos(angle), roundoff) << t;
    EXPECT_NEAR(b[program.plane[1]], magnitude * std::sin(angle), roundoff) << t;
    EXPECT_EQ(b[3 - program.plane[0] - program.plane[1]], 0);
}

TEST(FieldProgram, ConstantKeepsItsDirectionInItsPlane) {
    expect_polar({{1, 0}, ConstantField{0.02, 2.0}}, 5, 0.02, 2.0);
}

TEST(FieldProgram, TableIsLinearBetweenItsRowsAndRepeats) {
    const FieldProgram program = strokes();
    expect_polar(program, 0, -0.017, 0.3);
    expect_polar(program, 0.01, 0, 0.3);
    expect_polar(program, 0.0275, -0.0085, 0.3);
    expect_polar(program, 0.035, -0.017, 0.3);
    // Ten periods later; 0.41 is rounded by 1e-17 s, the slope is 1.7 T/s.
    const Vec3 later = field_at(program, 0.415);
    EXPECT_NEAR(later[0], 0.0085 * std::cos(0.3), 1e-15);
}

// Of all tables: one of a course that begins later is held until then, and repeats after.
TEST(FieldProgram, TableThatRepeatsIsHeldBeforeItsFirstRow) {
    const std::vector<double> time{1, 2, 4}, value{0.01, 0.02, 0.01};
    const std::vector<Vec3> vector{{0.01, 0, 0}, {0.02, 0, 0}, {0.01, 0, 0}};
    const FieldProgram plane{{0, 2}, FieldTable{time, value, {0}, true}};
    const FieldProgram space{{0, 2}, VectorTable{time, vector, true, {}, {}}};
    for (const auto& [t, field] : {std::pair(-7.0, 0.01),
                                   {0.0, 0.01},
                                   {0.99, 0.01},
                                   {1.0, 0.01},
                                   {1.5, 0.015},
                                   {3.0, 0.015},
                                   {4.5, 0.015},
                                   {7.5, 0.015},
                                   {32.0, 0.02}}) {
        EXPECT_NEAR(field_at(plane, t)[0], field, 1e-15) << t;
        EXPECT_NEAR(field_at(space, t)[0], field, 1e-15) << t;
        EXPECT_NEAR(rows_at(time, true, t).of(value), field, 1e-15) << t;
    }
}

TEST(FieldProgram, TableHoldsItsEndsAndJumps) {
    const FieldProgram program{
        {0, 2},
        FieldTable{{1, 2, 2, 3}, {0.01, 0.02, 0.005, 0.005}, {0, 1, 1, 2}, false}};
    expect_polar(program, -1, 0.01, 0);
    expect_polar(program, 1.5, 0.015, 0.5);
    expect_polar(program, 2, 0.005, 1);
    expect_polar(program, 2.5, 0.005, 1.5);
    expect_polar(program, 9, 0.005, 2);
}

TEST(FieldProgram, RotationTurnsFromTheFirstAxisToTheSecond) {
    const FieldProgram program{{0, 1}, RotatingField{0.01, pi / 2, 4}};
    expect_polar(program, 0.0625, 0.01, pi / 2 + pi / 2);
}

FieldProgram spatial(FieldLaw law) {
    return {{0, 2}, std::move(law)};
}

// About a slanted axis: the parts along and across it, the sense of the turn, the start.
TEST(FieldProgram, PrecessionKeepsItsConeAndTurnsRightHanded) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 2) / 3;
    const FieldProgram program =
        spatial(PrecessingField{0.01, {2, 4, 4}, 0.7, 5, 0.2, 0});
    const auto at = [&](double t) {
        return Eigen::Vector3d(field_at(program, t).data());
    };
    for (const double t : {0.0, 0.013, 0.11}) {
        EXPECT_NEAR(at(t).dot(axis), 0.01 * std::cos(0.7), roundoff);
        EXPECT_NEAR(at(t).norm(), 0.01, roundoff);
        // A quarter of a turn later, axis x B is where the part across was.
        const Eigen::Vector3d across = at(t) - at(t).dot(axis) * axis;
        const Eigen::Vector3d later = at(t + 0.05) - at(t + 0.05).dot(axis) * axis;
        EXPECT_NEAR((later - axis.cross(across)).norm(), 0, 1e-16) << t;
    }
    // y is the nearest of x, y, z (the first of two that are as near), z the next.
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d from = (z - z.dot(axis) * axis).normalized();
    const Eigen::Vector3d across = at(0) - at(0).dot(axis) * axis;
    EXPECT_NEAR(across.normalized().dot(from), std::cos(0.2), 1e-15);
}

TEST(FieldProgram, PrecessionAcrossAnAxisIsARotation) {
    const FieldProgram plane{{0, 1}, RotatingField{0.01, 0.4, 3}};
    const FieldProgram space =
        spatial(PrecessingField{0.01, {0, 0, 5}, pi / 2, 3, 0.4, 0});
    for (const double t : {0.0, 0.1, 0.77}) {
        for (std::size_t d = 0; d < 3; ++d)
            EXPECT_NEAR(field_at(space, t)[d], field_at(plane, t)[d], roundoff);
    }
}

TEST(FieldProgram, RampRisesFromZero) {
    const FieldProgram program = spatial(PrecessingField{0.02, {0, 0, 1}, 0, 3, 0, 0.4});
    EXPECT_EQ(field_at(program, 0)[2], 0);
    EXPECT_NEAR(field_at(program, 0.1)[2], 0.01 * (1 - std::cos(pi / 4)), roundoff);
    EXPECT_EQ(field_at(program, 0.4)[2], 0.02);
    EXPECT_EQ(field_at(program, 7)[2], 0.02);
}

TEST(FieldProgram, LawsOfThreeComponentsAndTheirSum) {
    const VectorTable table{{0, 1, 3}, {{0, 1, 2}, {2, 3, 4}, {4, 3, 0}}, false, {}, {}};
    EXPECT_EQ(field_at(spatial(table), 2), (Vec3{3, 3, 2}));
    EXPECT_EQ(field_at(spatial(table), 5), (Vec3{4, 3, 0}));
    const OscillatingField swing{{0.01, 0, -0.02}, 5, pi / 2};
    EXPECT_NEAR(field_at(spatial(swing), 0.1)[2], 0.02, roundoff);
    FieldProgram sum{
        {0, 2}, ConstantField{0.1, 0}, {{VectorField{{0, 0.2, 0}}}, {swing}}};
    const Vec3 b = field_at(sum, 0);
    EXPECT_NEAR(b[0], 0.11, 1e-16);
    EXPECT_EQ(b[1], 0.2);
    EXPECT_NEAR(field_magnitude_at(sum, 0), std::hypot(b[0], b[1], b[2]), 1e-16);
    EXPECT_EQ(field_magnitude_at({{0, 2}, ConstantField{-0.1, 0}}, 0), -0.1);
}

TEST(FieldProgram, ArgumentsReadBackExactly) {
    const FieldProgram rotating{{2, 1}, RotatingField{0.01 / 3, pi / 7, -25}};
    const FieldProgram constant{{0, 2}, ConstantField{-0.02, 1.0 / 3}};
    const FieldProgram vectors = spatial(VectorTable{
        {0, 0.02, 0.03}, {{0.1, 1.0 / 3, 0}, {0, 0, 1}, {1e-9, 0, 0}}, true, {}, {}});
    FieldProgram sum =
        spatial(PrecessingField{0.01, {1, 2, 1.0 / 3}, 0.7, -25, 0.1, 0.02});
    sum.plus = {{VectorField{{1e-3, 0, 1.0 / 7}}},
                {OscillatingField{{0, 1.0 / 9, 0}, 3, 0.3}},
                {ConstantField{0.01, 1.0 / 3}}};
    const FieldProgram formula =
        spatial(FormulaField{{{{.si = "0.012*sin(2*pi*25*t)"}, {}, {.si = "t<1?1:2"}}}});
    for (const FieldProgram& program :
         {strokes(), rotating, constant, vectors, sum, formula}) {
        std::vector<std::string> words;
        std::istringstream text(field_arguments(program));
        for (std::string word; text >> word;) words.push_back(word);
        const FieldProgram back = parse_field_arguments(words);
        for (double t : {0.0, 0.0123, 0.0377, 1.1111}) {
            EXPECT_EQ(field_at(back, t), field_at(program, t));
        }
    }
}

TEST(FieldProgram, RefusesWhatIsNoProgram) {
    using Words = std::vector<std::string>;
    for (const Words& words :
         {Words{}, Words{"xz"}, Words{"xx", "constant", "1", "2"},
          Words{"xw", "constant", "1", "2"}, Words{"xz", "constant", "1"},
          Words{"xz", "constant", "1", "2mT"}, Words{"xz", "table", "0", "1"},
          Words{"xz", "table", "1", "0", "0", "0", "0", "0"},
          Words{"xz", "repeat", "1", "0", "0"}, Words{"xz", "spiral", "1", "0", "0"},
          Words{"xz", "vector", "1", "0"}, Words{"xz", "vector", "1", "0", "0", "plus"},
          Words{"xz", "plus", "vector", "1", "0", "0"},
          Words{"xz", "vectors", "1", "0", "0", "0", "0", "0", "0", "0"},
          Words{"xz", "precessing", "1", "0", "0", "0", "1", "5", "0", "0"},
          Words{"xz", "formula", "t", "0"}, Words{"xz", "formula", "t", "0", "x"},
          Words{"xz", "formula", "t", "0", "t=1"}}) {
        EXPECT_THROW(parse_field_arguments(words), std::invalid_argument);
    }
    EXPECT_THROW(field_arguments({{0, 2}, FieldTable{{0, 1}, {1, 1}, {0, 1, 2}, false}}),
                 std::invalid_argument);
}

// Where a body starts: its relaxed shape, turned and moved.
Body strip() {
    Body body;
    body.name = "strip";
    body.mesh = box_mesh({{3.7e-3, 1.5e-3, 0.185e-3}, {20, 8, 2}});
    body.material = test::soft_material();
    body.element = ElementVariant::assumed_strain;
    body.magnetization_a_m =
        harmonic_magnetization(body.mesh, {62e3, 3.7e-3, pi / 4, 0, 2});
    return body;
}

TEST(Placement, TurnsAndMovesTheCentreOfVolume) {
    const Body body = strip();
    Placement placement;
    placement.rotation = PlaneRotation{{0, 2}, pi / 2};
    placement.position_m = Vec3{8e-3, 4e-3, 5e-3};
    const auto nodes = placed_nodes(body, placement, {0, 2});
    // The length now points along z: the first node, at (-L/2, -w/2, -h/2) of the centre,
    // comes to (h/2, -w/2, -L/2).
    EXPECT_NEAR(nodes[0][0], 8e-3 + 0.0925e-3, 1e-15);
    EXPECT_NEAR(nodes[0][1], 4e-3 - 0.75e-3, 1e-15);
    EXPECT_NEAR(nodes[0][2], 5e-3 - 1.85e-3, 1e-15);
}

TEST(Placement, KeepsTheCentreOfARelaxedFreeBody) {
    const Body body = strip();
    const auto nodes = relaxed_shape(body, field_vector({17e-3, 255 * pi / 180}, {0, 2}));
    const double thirds[3] = {0.5 * 3.7e-3, 0.5 * 1.5e-3, 0.5 * 0.185e-3};
    for (int d = 0; d < 3; ++d) {
        double moment = 0;
        double mass = 0;
        for (const Hexahedron& element : body.mesh.elements) {
            for (int node : element) {
                moment += nodes[node][d];
                mass += 1;
            }
        }
        EXPECT_NEAR(moment / mass, thirds[d], 1e-12);  // 1e-9 of the length
    }
}

// Held along y by rollers, the strip still turns and bends in the x-z plane as the free
// one does.
TEST(Placement, RelaxesOnRollers) {
    Body body = strip();
    body.material.lame_lambda_pa = 1e-3 * body.material.shear_modulus_pa;  // no Poisson
    const Vec3 field = field_vector({5e-3, 270 * pi / 180}, {0, 2});
    const auto free = relaxed_shape(body, field);
    body.rollers = {{{"y_min"}, 1}, {{"y_max"}, 1}};
    const auto held = relaxed_shape(body, field);
    for (std::size_t n = 0; n < free.size(); ++n) {
        EXPECT_NEAR(held[n][0], free[n][0], 0.02 * 3.7e-3);
        EXPECT_NEAR(held[n][2], free[n][2], 0.02 * 3.7e-3);
    }
    for (const char* face : {"y_min", "y_max"}) {
        for (int node : body.mesh.faces.at(face)) {
            EXPECT_EQ(held[node][1], body.mesh.nodes[node][1]);
        }
    }
}

TEST(Placement, NamesTheBodyThatFindsNoRelaxedShape) {
    Body body = strip();
    body.mesh = box_mesh({{3.7e-3, 1.5e-3, 0.185e-3}, {6, 2, 2}});
    body.magnetization_a_m =
        harmonic_magnetization(body.mesh, {62e3, 3.7e-3, pi / 4, 0, 2});
    const auto what = test::message_of<std::runtime_error>([&] {
        relaxed_shape(body, {0, 0, 500.0});
    });
    EXPECT_TRUE(what.starts_with("body strip: no equilibrium at 1 of the load")) << what;
    test::expect_says(what, {"relaxed in the field (0, 0, 500) T"});
}

}  // namespace
}  // namespace magfsi::structure
