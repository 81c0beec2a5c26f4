// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers with units, near words, and the bytes of a file.
#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include "adapters/scene/document.h"
#include "adapters/scene/fault.h"
#include "adapters/scene/keys.h"
#include "adapters/scene/quantity.h"
#include "adapters/scene/reader.h"
#include "tests/support/checks.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

struct Right {
    const char* text;
    const char* unit;
    double value;
};

class Quantity : public testing::TestWithParam<Right> {};

// Equality is exact: a literal of the compiler is the correctly rounded decimal too.
TEST_P(Quantity, is_read_exactly) {
    EXPECT_EQ(parse_quantity(GetParam().text, GetParam().unit), GetParam().value)
        << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    of_scenes, Quantity,
    testing::Values(
        Right{"17 mT", "T", 0.017}, Right{"-17 mT", "T", -0.017},
        Right{"185 um", "m", 185e-6}, Right{"185 \u00b5m", "m", 185e-6},
        Right{"185 \u03bcm", "m", 185e-6}, Right{"0.185 mm", "m", 185e-6},
        Right{"33 kPa", "Pa", 33000}, Right{"33kPa", "Pa", 33000},
        Right{"9.81 m/s2", "m/s2", 9.81}, Right{"9.81 m/s^2", "m/s2", 9.81},
        Right{"9.81 m s^-2", "m/s2", 9.81}, Right{"9.81 m/s\u00b2", "m/s2", 9.81},
        Right{"9.81 m/s**2", "m/s2", 9.81}, Right{"1860 kg/m3", "kg/m3", 1860},
        Right{"1.86 g/cm3", "kg/m3", 1860}, Right{"62 kA/m", "A/m", 62000},
        Right{"1 mm2/s", "m2/s", 1e-6}, Right{"1 mm\u00b2/s", "m2/s", 1e-6},
        Right{"25 Hz", "1/s", 25}, Right{"600 1/s", "1/s", 600},
        Right{"600 s^-1", "1/s", 600}, Right{"10 Pa/m", "N/m3", 10},
        Right{"10 N/m3", "N/m3", 10}, Right{"1 mN/cm3", "N/m3", 1000},
        Right{"1 kg/m2/s2", "N/m3", 1}, Right{"1 J/m3", "Pa", 1}, Right{"1 N m", "J", 1},
        Right{"1 N*m", "J", 1}, Right{"1 N\u00b7m", "J", 1}, Right{"1 kg m2/s2", "J", 1},
        Right{"1 W s", "J", 1}, Right{"1 N/A/m", "T", 1}, Right{"1 bar", "Pa", 1e5},
        Right{"2 mL", "m3", 2e-6}, Right{"1 hPa", "Pa", 100}, Right{"1 GPa", "Pa", 1e9},
        Right{"1 MPa", "Pa", 1e6}, Right{"120 ms", "s", 0.12}, Right{"20 us", "s", 20e-6},
        Right{"1.5 min", "s", 90}, Right{"0.25 h", "s", 900}, Right{"1 dm", "m", 0.1},
        Right{"+.5 m", "m", 0.5}, Right{"5. m", "m", 5}, Right{"2e-4 m", "m", 0.0002},
        Right{"2E+1 m", "m", 20}, Right{"0.5", "", 0.5}, Right{"-3e2", "", -300},
        Right{"1 mrad", "rad", 0.001}, Right{"50 G", "T", 5e-3},
        Right{"45\u00b0", "rad", std::numbers::pi / 4}, Right{"5\u00a0mT", "T", 5e-3},
        Right{"5\u2009mT", "T", 5e-3}, Right{"5\u202fmT", "T", 5e-3},
        Right{"5\xa0mT", "T", 5e-3}, Right{"185\u2009\xb5m", "m", 185e-6},
        Right{"\u22125 mT", "T", -5e-3}, Right{"\u20135 mT", "T", -5e-3},
        Right{"9.81 m s\u207b\u00b2", "m/s2", 9.81},
        Right{"9.81 m\u00b7s^-2", "m/s2", 9.81},
        Right{"9.81 m\u22c5s\u207b\u00b2", "m/s2", 9.81}, Right{"2e\u22123 m", "m", 2e-3},
        Right{"1 km", "m", 1000}, Right{"1 / s", "1/s", 1}));

TEST(Quantity, of_the_same_length_is_the_same_double_however_it_is_written) {
    const double reference = parse_quantity("2e-4 m", "m");
    for (const char* text :
         {"0.2 mm", "200 um", "0.0002 m", "2e2 um", "200000 nm", "0.02 cm"})
        EXPECT_EQ(parse_quantity(text, "m"), reference) << text;
    // The product of a double and a scale would differ: 4.1 * 1e-3 is not 4.1e-3.
    EXPECT_NE(4.1 * 1e-3, 4.1e-3);
    EXPECT_EQ(parse_quantity("4.1 mm", "m"), 4.1e-3);
}

TEST(Quantity, in_degrees_is_the_rounded_multiple_of_pi) {
    EXPECT_EQ(parse_quantity("180 deg", "rad"), std::numbers::pi);
    EXPECT_EQ(parse_quantity("90 deg", "rad"), std::numbers::pi / 2);
    EXPECT_EQ(parse_quantity("45 deg", "rad"), std::numbers::pi / 4);
    // 60 deg = pi / 3 has its own rounding: one unit in the last place.
    EXPECT_DOUBLE_EQ(parse_quantity("60 deg", "rad"), std::numbers::pi / 3);
    EXPECT_DOUBLE_EQ(parse_quantity("90 deg/s", "rad/s"), std::numbers::pi / 2);
}

TEST(Quantity, of_minus_zero_is_zero) {
    EXPECT_FALSE(std::signbit(parse_quantity("-0 mm", "m")));
}

struct Wrong {
    const char* text;
    const char* unit;
    const char* fragment;
};

class WrongQuantity : public testing::TestWithParam<Wrong> {};

TEST_P(WrongQuantity, is_refused_with_its_reason) {
    test::expect_refusal<Complaint>(
        [] { parse_quantity(GetParam().text, GetParam().unit); }, {GetParam().fragment});
}

INSTANTIATE_TEST_SUITE_P(
    of_scenes, WrongQuantity,
    testing::Values(
        Wrong{"5", "m", "without a unit; allowed a length such as 0.2 mm; \"5 m\" if SI"},
        Wrong{"0", "T", "allowed a magnetic flux density such as 17 mT"},
        Wrong{"5 kg", "m", "\"5 kg\", a mass; allowed a length"},
        Wrong{"5 mm", "rad", "a length; allowed an angle such as 45 deg"},
        Wrong{"45 deg", "", "an angle; allowed a plain number"},
        Wrong{"5 deg", "1/s", "an angle; allowed a rate"},
        Wrong{"5 kg m", "N", "a quantity in kg^1 m^1; allowed a force"},
        Wrong{"17 mt", "T", "did you mean \"mT\"?"},
        Wrong{"33 KPa", "Pa", "did you mean \"kPa\"?"},
        Wrong{"5 hz", "1/s", "did you mean \"Hz\"?"},
        Wrong{"5 tesla", "T", "did you mean \"T\"?"},
        Wrong{"45 degrees", "rad", "did you mean \"deg\"?"},
        Wrong{"5,0 mT", "T", "write \"5.0 mT\""}, Wrong{"5, mT", "T", "comma"},
        Wrong{"1 000 mm", "m", "digits of a number together"},
        Wrong{"1\u202f000 mm", "m", "digits of a number together"},
        Wrong{"5 \u00d7 mT", "T", "U+00D7"}, Wrong{"\u0665 mT", "T", "U+0665"},
        Wrong{"5 \xff mT", "T", "0xFF"},
        Wrong{"4 Mm", "m", "at most 1000 m; did you mean \"4 mm\"?"},
        Wrong{"5 MT", "T", "did you mean \"5 mT\"?"},
        Wrong{"60 T", "T", "did you mean \"60 mT\"?"},
        Wrong{"-5 MT", "T", "did you mean \"-5 mT\"?"},
        Wrong{"62 GA/m", "A/m", "did you mean \"62 kA/m\"?"},
        Wrong{"9.81 Mm/s2", "m/s2", "did you mean \"9.81 mm/s2\"?"},
        Wrong{"5 GHz", "1/s", "at most"}, Wrong{"1 MT/m", "T/m", "\"1 mT/m\""},
        Wrong{"1 MA", "A", "\"1 mA\""}, Wrong{"1 MA m2", "A m2", "\"1 mA m2\""},
        Wrong{"1 Ms", "s", "\"1 ms\""}, Wrong{"330 TPa", "Pa", "\"330 kPa\""},
        Wrong{"1860 Mg/m3", "kg/m3", "\"1860 kg/m3\""}, Wrong{"20 T", "A/m", "at most"},
        Wrong{"20 Ms", "s", "did you mean \"20 ms\"?"}, Wrong{"5 Gs", "s", "at most"},
        Wrong{"1 mmm", "m", "unknown unit \"mmm\""}, Wrong{"1 kmin", "s", "unknown unit"},
        Wrong{"1 m/s/", "m/s", "incomplete unit"},
        Wrong{"1 m//s", "m/s", "incomplete unit"}, Wrong{"1 *m", "m", "incomplete unit"},
        Wrong{"1 kg/m s", "kg/m3", "write N/m/s"},
        Wrong{"1 m12", "m", "powers from -9 to 9"},
        Wrong{"1 m^", "m", "powers from -9 to 9"},
        Wrong{"nan", "", "\"nan\"; allowed a plain number"},
        Wrong{"nan m", "m", "allowed a length"}, Wrong{"inf m", "m", "allowed a length"},
        Wrong{".inf", "", "allowed a plain number"},
        Wrong{"-inf", "", "allowed a plain number"},
        Wrong{"1e999 m", "m", "a double holds"},
        Wrong{"1e99999999999 m", "m", "allowed a length"},
        Wrong{"", "m", "allowed a length"}, Wrong{"mm", "m", "allowed a length"},
        Wrong{"- 5 mm", "m", "allowed a length"},
        Wrong{"0x10 m", "m", "unknown unit \"x\""},
        Wrong{"1,5 mm", "m", "write \"1.5 mm\" if the comma is one"},
        Wrong{"1_000 m", "m", "unknown unit"}, Wrong{"5 mm 3", "m", "unknown unit"},
        Wrong{"1 2 m", "m", "the digits of a number together"},
        Wrong{"5 (m/s)", "m/s", "unknown unit"}));

TEST(Format, picks_the_handy_prefix) {
    EXPECT_EQ(format_si(2e-4, "m"), "200 um");
    EXPECT_EQ(format_si(1e-3, "m"), "1 mm");
    EXPECT_EQ(format_si(0.999e-3, "m"), "999 um");
    EXPECT_EQ(format_si(-0.017, "T"), "-17 mT");
    EXPECT_EQ(format_si(33000, "Pa"), "33 kPa");
    EXPECT_EQ(format_si(0, "m"), "0 m");
    EXPECT_EQ(format_si(1860, "kg/m3"), "1860 kg/m3");
    EXPECT_EQ(format_si(1e-12, "s"), "0.001 ns");
    EXPECT_EQ(format_si(0.5, ""), "0.5");
}

// Near names are found; far ones are not forced upon anyone.

const std::vector<std::string> keys = {"spacing", "density", "viscosity",
                                       "box",     "m",       "mT"};

TEST(Suggestion, finds_a_letter_missing_added_changed_or_swapped) {
    EXPECT_EQ(nearest("spacin", keys), "spacing");
    EXPECT_EQ(nearest("denssity", keys), "density");
    EXPECT_EQ(nearest("viscozity", keys), "viscosity");
    EXPECT_EQ(nearest("bxo", keys), "box");
}

TEST(Suggestion, prefers_a_difference_of_case) {
    EXPECT_EQ(nearest("MT", keys), "mT");
    EXPECT_EQ(nearest("Density", keys), "density");
}

TEST(Suggestion, is_silent_when_nothing_is_near) {
    EXPECT_EQ(nearest("turbulence", keys), "");
    EXPECT_EQ(nearest("", keys), "");
    EXPECT_EQ(nearest("q", keys), "");
    EXPECT_EQ(did_you_mean("turbulence", keys), "");
    EXPECT_EQ(did_you_mean("spacin", keys), "did you mean \"spacing\"?");
}

// Scene files are UTF-8; what is not is refused with its place.

TEST(Utf8, takes_every_length) {
    for (const char* text :
         {"", "plain", "\x7F", "\xC2\x80", "\xE2\x82\xAC", "\xED\x9F\xBF", "\xEE\x80\x80",
          "\xF0\x9F\xA4\x96", "\xF4\x8F\xBF\xBF"})
        EXPECT_EQ(first_fault_in_utf8(text), std::string_view::npos) << text;
}

TEST(Utf8, finds_the_first_fault) {
    // A lone continuation, long forms, a surrogate, beyond the last character, cut short.
    for (const char* fault :
         {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xED\xA0\x80",
          "\xF0\x80\x80\x80", "\xF4\x90\x80\x80", "\xF5", "\xFF", "\xE2\x82", "\xC2"})
        EXPECT_EQ(first_fault_in_utf8("\xC2\xB5m " + std::string(fault)), 4u);
}

// --set changes exactly what it names, and its faults are reported under its own name.
Scene with(const std::vector<std::string>& overrides) {
    return read_scene(test_folder / "complete/swimmer.yaml", overrides);
}

std::string error_of(const std::vector<std::string>& overrides) {
    return test::message_of<SceneError>([&] { with(overrides); });
}

TEST(Override, replaces_a_value) {
    EXPECT_EQ(with({"fluid.spacing=0.4 mm"}).fluid->spacing_m, 0.4e-3);
    EXPECT_EQ(with({"time.end=1 s", "time.end=2 s"}).time.end_s, 2);
}

TEST(Override, may_hold_equals_signs_and_colons) {
    EXPECT_EQ(with({"name=a=b"}).name, "a=b");
    EXPECT_EQ(with({"name=\"a: b\""}).name, "a: b");
}

TEST(Override, replaces_lists_and_maps) {
    EXPECT_EQ(with({"fluid.box=[8 mm, 8 mm, 8 mm]",
                    "bodies.robot.initial={position: [4 mm, 4 mm, 4 mm]}"})
                  .fluid->box_m,
              (Vec3{8e-3, 8e-3, 8e-3}));
}

TEST(Override, reaches_an_item_of_a_list) {
    const Scene s = with({"magnetic_field.table.time.1=20 ms"});
    EXPECT_EQ(std::get<FieldTable>(s.magnetic_field->course).time_s[1], 0.02);
    const Scene domains =
        read_scene(test_folder / "complete/elastic.yaml",
                   {"bodies.plate.magnetization.domains.1.vector.0=5 A/m"});
    EXPECT_EQ(std::get<DomainMagnetization>(*domains.bodies[1].magnetization)
                  .domains[1]
                  .vector_a_m[0],
              5);
}

TEST(Override, creates_what_is_missing) {
    const Scene s =
        read_scene(test_folder / "minimal.yaml",
                   {"damping.rate=5 1/s", "coupling.immersed_boundary.strength=0.5",
                    "fluid.boundaries.z_max.no_slip.velocity=[1 mm/s, 0 m/s, 0 m/s]"});
    EXPECT_EQ(s.damping->rate_1_s, 5);
    EXPECT_EQ(s.coupling->immersed_boundary.strength, 0.5);
    EXPECT_EQ(s.fluid->boundaries[5].wall_velocity_m_s[0], 1e-3);
}

TEST(Override, of_nothing_removes_a_key) {
    EXPECT_FALSE(with({"gravity="}).gravity);
    EXPECT_FALSE(with({"gravity=null"}).gravity);
    EXPECT_FALSE(with({"fluid.body_force="}).fluid->body_force_n_m3);
}

struct WrongSet {
    const char* override_text;
    const char* message;  // its beginning
};

class WrongOverride : public testing::TestWithParam<WrongSet> {};

TEST_P(WrongOverride, is_reported_under_its_own_name) {
    const std::string message = error_of({GetParam().override_text});
    EXPECT_TRUE(message.starts_with(GetParam().message)) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    of_a_scene, WrongOverride,
    testing::Values(
        WrongSet{"fluid.spacin=1 mm",
                 "--set fluid.spacin: found the unknown key \"spacin\""},
        WrongSet{"fluid.spacing=1", "--set fluid.spacing: found \"1\" without a unit"},
        WrongSet{"fluid.spacing=0.3 mm", "--set fluid.spacing: found the spacing 300 um"},
        WrongSet{"fluid.box=[1 m, 2 m]", "--set fluid.box: found a list of 2 values"},
        WrongSet{"fluid.box=[1 m, 2 m", "--set fluid.box: found no valid YAML"},
        WrongSet{"fluid.box=[1 m]\n---\n2", "--set fluid.box: found a second document"},
        WrongSet{"time.end.more=1 s", "--set time.end.more: found a map"},
        WrongSet{"time.step", "--set time.step: found no \"=\""},
        WrongSet{"time..step=1 s", "--set time..step: found an empty name"},
        WrongSet{"=1 s", "--set : found an empty name"},
        WrongSet{"gravty=", "--set gravty: found no such key to remove"},
        WrongSet{"magnetic_field.table.time.3=1 s",
                 "--set magnetic_field.table.time.3: found "
                 "item \"3\" of a list of 3 values"},
        WrongSet{"magnetic_field.constant.magnitude=1 T",
                 "--set magnetic_field.constant.magnitude: found no key \"direction\""},
        WrongSet{"fluid={spacing: 1 mm, spacing: 2 mm}",
                 "--set fluid: found the key \"spacing\" twice"}));

TEST(Override, leaves_the_places_of_the_rest) {
    const std::string file = (test_folder / "complete/swimmer.yaml").string();
    const std::string message = error_of({"time.step=1 ms"});
    // Line 31 holds expected_speed, which is too fast for that step.
    EXPECT_TRUE(message.starts_with(file + ":31:19: found the expected speed"))
        << message;
}

}  // namespace
}  // namespace magfsi::scene
