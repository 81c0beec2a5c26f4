// SPDX-License-Identifier: GPL-2.0-or-later
// Formulas of the time: their values, and that units must cancel.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adapters/scene/fault.h"
#include "adapters/scene/formula_units.h"
#include "adapters/scene/reader.h"
#include "structure/formula.h"
#include "tests/support/checks.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

constexpr double pi = std::numbers::pi;

double value(const std::string& text, const char* unit, double t) {
    return structure::value_at(formula_in_si(text, unit), t);
}

TEST(Formula, has_the_value_of_its_numbers_and_units) {
    const double t = 0.0123, roundoff = 1e-16;
    EXPECT_NEAR(value("12 mT * sin(2*pi*25 Hz*t)", "T", t),
                0.012 * std::sin(2 * pi * 25 * t), roundoff);
    EXPECT_EQ(value("17 mT", "T", t), 0.017);
    EXPECT_EQ(value("-17mT", "T", t), -0.017);
    EXPECT_EQ(value("0", "T", t), 0);
    EXPECT_EQ(value("0.5 mT/ms*t", "T", t), 0.5 * t);
    EXPECT_EQ(value("3 mT/t*1 s", "T", 2), 0.0015);
    EXPECT_EQ(value("1 mm/min(1 s, t)", "m/s", 0.5), 0.002);
    EXPECT_EQ(value("sqrt(4 mm2/s^2)", "m/s", t), 0.002);
    EXPECT_EQ(value("4 mm^2/s2/2 mm*1 s", "m/s", t), 0.002);
    EXPECT_EQ(value("t < 20 ms ? 1 mT : 2 mT", "T", 0.03), 0.002);
    EXPECT_EQ(value("mod(t, 0.8 s) == 0.25 s ? 1 T : 0", "T", 4.25), 1);
    EXPECT_EQ(value("max(0, 1 - 50 %*t/1 s)*1 T", "T", 1), 0.5);
    EXPECT_NEAR(value("1 T*cos(90 deg)", "T", t), 0, roundoff);
    EXPECT_EQ(value("1 T*(1 + (t/1 s)^0.3)", "T", 1), 2);
}

// Numbers have the same double as elsewhere in a scene: by their decimal digits.
TEST(Formula, has_the_numbers_of_other_keys) {
    EXPECT_EQ(formula_in_si("200 um", "m"), formula_in_si("0.2 mm", "m"));
    EXPECT_EQ(formula_in_si("  1 mT *\tt / 3 ms ", "T"), "0.001*t/0.003");
}

// More than are kept at once.
TEST(Formula, of_many_is_the_one_that_was_asked_for) {
    for (int i = 0; i < 300; ++i)
        EXPECT_EQ(structure::value_at(std::to_string(i) + "+t", 0.5), i + 0.5);
    EXPECT_EQ(structure::value_at("7+t", 0.5), 7.5);
}

struct Wrong {
    const char* text;
    const char* says;
};

class WrongFormula : public testing::TestWithParam<Wrong> {};

TEST_P(WrongFormula, is_refused) {
    const std::string message =
        test::message_of<Complaint>([] { formula_in_si(GetParam().text, "T"); });
    test::expect_says(message, {GetParam().says});
}

INSTANTIATE_TEST_SUITE_P(
    of_flux_densities, WrongFormula,
    testing::Values(
        Wrong{"12",
              "a plain number; allowed a magnetic flux density such as 17 mT, as a "
              "formula of"},
        Wrong{"12 mm*sin(2*pi*25 Hz*t)", "a length"}, Wrong{"12 mT*t", "kg^1 s^-1 A^-1"},
        Wrong{"12 mT*sin(2*pi*25*t)",
              "the argument of sin is a time, \"2*pi*25*t\" must be a plain number"},
        Wrong{"12 mT + 3 ms", "not of one kind"}, Wrong{"12 mT + t", "not of one kind"},
        Wrong{"12 mT*(1 + t)", "not of one kind"},
        Wrong{"t < 20 ? 1 mT : 2 mT", "not of one kind"},
        Wrong{"mod(t, 0.8) < 0.1 s ? 1 mT : 0", "not of one kind"},
        Wrong{"(2 mT)^(3 ms/t*t)", "not of one kind"},
        Wrong{"1 mT*2^(3 Hz*t*t)", "not of one kind"},
        Wrong{"12 mTT", "the unknown unit \"mTT\""}, Wrong{"3 mT 4", "an operator"},
        Wrong{"2 t*1 mT", "an operator"}, Wrong{"sin(t/1 s", "Missing parenthesis"},
        Wrong{"bar(t)*1 T", "bar"}, Wrong{"1 mT*x", "\"x\""}, Wrong{"t = 1 mT", "=="},
        Wrong{"1 mT, 2 mT", "separated by commas"}, Wrong{".", "\".\""}));

TEST(Formula, that_has_no_value_names_itself_and_the_time) {
    const std::string message = test::message_of<std::runtime_error>(
        [] { structure::value_at("sqrt(1-t)", 2.5); });
    test::expect_says(message, {"sqrt(1-t)", "not a number", "t = 2.5 s"});
}

// --- courses of inlets

Scene pulsing(const std::string& course) {
    return read_scene(source_folder / "docs/examples/scenes/pulse.yaml",
                      {"fluid.boundaries.x_min.velocity_inlet.course=" + course});
}

const Inlet& inlet(const Scene& s) {
    return s.fluid->boundaries[0].inlet;
}

TEST(InletCourse, is_a_factor_of_the_time) {
    const Scene wave = pulsing(
        "{oscillation: {mean: 0.5, amplitude: 0.25, frequency: 10 Hz, phase: 90 deg}}");
    EXPECT_DOUBLE_EQ(inlet(wave).factor(0.1), 0.75);
    EXPECT_EQ(inlet(wave).peak_factor, 0.75);
    const Scene rows =
        pulsing("{table: {time: [0 s, 1 s, 2 s], factor: [0, -2, 0], repeat: true}}");
    EXPECT_EQ(inlet(rows).factor(4.5), -1);
    EXPECT_EQ(inlet(rows).peak_factor, 2);
    const Scene file = pulsing("{table: {file: pulse.csv, repeat: true}}");
    EXPECT_EQ(inlet(file).factor(1e-3), 1.5);
    const Scene formula = pulsing("{formula: 1 + t/1 ms}");
    EXPECT_EQ(inlet(formula).factor(1e-3), 2);
    EXPECT_EQ(inlet(formula).peak_factor, 1 + formula.time.end_s / 1e-3);
    EXPECT_NE(formula.hash, rows.hash);
}

TEST(InletCourse, that_cannot_be_is_refused) {
    const auto says = [](const std::string& course, const char* what) {
        test::expect_says(test::message_of<SceneError>([&] { pulsing(course); }), {what});
    };
    says("{formula: 1 + t}", "not of one kind");
    says("{formula: 2 mm}", "a length; allowed a plain number");
    says("{formula: 'sqrt(0.5 - t/1 s*1e6)'}", "not a number at t = ");
    says("{table: {time: [1 s, 0 s], factor: [1, 2]}}", "times that do not ascend");
    says("{table: {time: [0 s, 1 s], factor: [1]}}", "1 factors for 2 times");
    says("{table: {repeat: true}}", "a table without time");
    says("{table: {file: absent.csv}}", "absent.csv");
    // 20 mm/s times 100 is more than the lattice bears.
    says("{formula: 1000*t/1 ms}", "the largest velocity of the inlet's course");
    EXPECT_THROW(read_scene(source_folder / "docs/examples/scenes/pulse.yaml",
                            {"fluid.solver=openfoam"}),
                 SceneError);
}

// A formula is kept as it is written; its hash is that of the text.
TEST(Formula, reaches_the_field_in_either_place) {
    const auto file = source_folder / "docs/examples/scenes/formula.yaml";
    const Scene s = read_scene(file);
    const auto& first = std::get<FormulaField>(s.magnetic_field->course).component_t;
    EXPECT_EQ(first[0].written, "1 mT*(1 - exp(-t/0.3 ms))");
    EXPECT_EQ(first[1].si, "0");
    const auto& more = std::get<FormulaField>(s.magnetic_field->plus[0].law).component_t;
    EXPECT_EQ(structure::value_at(more[0].si, 1.1e-3), 0.5e-3);
    EXPECT_EQ(structure::value_at(more[0].si, 1.3e-3), 0);
    EXPECT_NE(read_scene(file, {"magnetic_field.formula.y=1 mT"}).hash, s.hash);
}

TEST(Formula, reaches_sources_and_motions) {
    const Scene s = read_scene(source_folder / "docs/examples/scenes/formula.yaml");
    const auto value = [](const structure::Formula& formula) {
        return structure::value_at(formula.si, 0.05);
    };
    const FieldSource& arm = s.magnetic_field->sources[0];
    EXPECT_EQ(value(std::get<Formula>(*arm.strength)), std::exp(-5));
    EXPECT_NEAR(value(std::get<FormulaMotion>(*arm.motion).component_m[0]), 2e-3, 1e-18);
    EXPECT_NEAR(value(std::get<Formula>(arm.turning->turns)), pi / 6, 1e-15);
    const auto& system = std::get<CoilSystem>(s.magnetic_field->sources[1].shape);
    EXPECT_NEAR(value(*system.coils[0].current), 0, 1e-14);
    const auto& motion = s.bodies[0].prescribed_motion[0];
    EXPECT_NEAR(value(std::get<FormulaMotion>(motion.course).component_m[2]), 0, 1e-17);
    const auto& turning =
        std::get<TurningMotion>(s.bodies[0].prescribed_motion[1].course);
    EXPECT_EQ(turning.about_m, (Vec3{4e-3, 0.5e-3, 0.25e-3}));
    // A quarter of a period: 3 deg.
    EXPECT_NEAR(structure::value_at(std::get<Formula>(turning.angle).si, 0.5e-3), pi / 60,
                1e-16);
}

TEST(Formula, of_a_source_or_a_motion_that_cannot_be_is_refused) {
    const auto says = [](const std::string& set,
                         std::initializer_list<std::string> what) {
        test::expect_says(
            test::message_of<SceneError>([&] {
                read_scene(source_folder / "docs/examples/scenes/formula.yaml", {set});
            }),
            what);
    };
    const std::string arm = "magnetic_field.sources.arm.";
    says(arm + "strength.formula=2 A", {"an electric current; allowed a plain number"});
    says(arm + "strength.formula=1/(1 ms - t)*1 ms", {"infinite at t = 1 ms"});
    says(arm + "motion.formula.y=3 mT", {"a magnetic flux density; allowed a length"});
    says(arm + "motion.formula.y=sqrt(1 ms - t)*1 m/sqrt(1 s)", {"not a number at t = "});
    says(arm + "turning.angle=2 Hz", {"allowed an angle"});
    says(arm + "turning.frequency=2 Hz", {"angle", "frequency"});
    const std::string coils = "magnetic_field.sources.coils.coil_system.coils.0.";
    says(coils + "current=3 V", {"\"V\""});
    says(coils + "currents=[1 A]", {"current beside currents"});
    const std::string motion = "bodies.strip.prescribed_motion.0.formula.";
    says(motion + "z=1/t*1 mm*1 s", {"infinite at t = 0 s"});
    says(motion + "z=2 s", {"a time; allowed a length"});
    const std::string turning = "bodies.strip.prescribed_motion.1.turning.";
    says(turning + "angle=1/(1 ms - t)*1 ms*1 rad", {"infinite at t = 1 ms"});
    says(turning + "angle=2 mm", {"a length; allowed an angle"});
    says(turning + "axis=[0, 0, 0]", {"an axis of length 0"});
    says(turning + "oscillation={amplitude: 1 deg, frequency: 1 Hz}",
         {"angle", "oscillation"});
}

}  // namespace
}  // namespace magfsi::scene
