// --set changes exactly what it names, and its faults are reported under its own name.
#include <gtest/gtest.h>

#include "adapters/scene/keys.h"
#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

Scene with(const std::vector<std::string>& overrides) {
    return read_scene(test_folder / "complete/swimmer.yaml", overrides);
}

std::string error_of(const std::vector<std::string>& overrides) {
    try {
        with(overrides);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no error";
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

struct Wrong {
    const char* override_text;
    const char* message;  // its beginning
};

class WrongOverride : public testing::TestWithParam<Wrong> {};

TEST_P(WrongOverride, is_reported_under_its_own_name) {
    const std::string message = error_of({GetParam().override_text});
    EXPECT_TRUE(message.starts_with(GetParam().message)) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    of_a_scene, WrongOverride,
    testing::Values(
        Wrong{"fluid.spacin=1 mm",
              "--set fluid.spacin: found the unknown key \"spacin\""},
        Wrong{"fluid.spacing=1", "--set fluid.spacing: found \"1\" without a unit"},
        Wrong{"fluid.spacing=0.3 mm", "--set fluid.spacing: found the spacing 300 um"},
        Wrong{"fluid.box=[1 m, 2 m]", "--set fluid.box: found a list of 2 values"},
        Wrong{"fluid.box=[1 m, 2 m", "--set fluid.box: found no valid YAML"},
        Wrong{"fluid.box=[1 m]\n---\n2", "--set fluid.box: found a second document"},
        Wrong{"time.end.more=1 s", "--set time.end.more: found a map"},
        Wrong{"time.step", "--set time.step: found no \"=\""},
        Wrong{"time..step=1 s", "--set time..step: found an empty name"},
        Wrong{"=1 s", "--set : found an empty name"},
        Wrong{"gravty=", "--set gravty: found no such key to remove"},
        Wrong{"magnetic_field.table.time.3=1 s",
              "--set magnetic_field.table.time.3: found "
              "item \"3\" of a list of 3 values"},
        Wrong{"magnetic_field.constant.magnitude=1 T",
              "--set magnetic_field.constant.magnitude: found no key \"direction\""},
        Wrong{"fluid={spacing: 1 mm, spacing: 2 mm}",
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
