// SPDX-License-Identifier: GPL-2.0-or-later
// Keys of the magnetic field and its sources reach their members; other ways to say a
// material.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "adapters/scene/effective.h"
#include "adapters/scene/keys.h"
#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

constexpr double pi = std::numbers::pi;

Scene complete(const char* name) {
    return read_scene(test_folder / "complete" / name);
}

TEST(Keys, of_fields_of_three_components) {
    const MagneticField field = *complete("spatial.yaml").magnetic_field;
    const auto& precession = std::get<PrecessingField>(field.course);
    EXPECT_EQ(precession.magnitude_t, 5e-3);
    EXPECT_EQ(precession.axis, (Vec3{0, 1, 1}));
    EXPECT_EQ(precession.frequency_hz, 8);
    EXPECT_DOUBLE_EQ(precession.cone_rad, pi / 3);
    EXPECT_EQ(precession.start_rad, pi / 2);
    EXPECT_EQ(precession.ramp_s, 0.2);
    ASSERT_EQ(field.plus.size(), 5u);
    EXPECT_EQ(std::get<VectorField>(field.plus[0].law).vector_t, (Vec3{1e-3, 0, -2e-3}));
    const auto& swing = std::get<OscillatingField>(field.plus[1].law);
    EXPECT_EQ(swing.amplitude_t, (Vec3{0, 3e-3, 0}));
    EXPECT_EQ(swing.frequency_hz, 2);
    EXPECT_EQ(swing.phase_rad, pi);
    EXPECT_EQ(std::get<RotatingField>(field.plus[4].law).frequency_hz, 5);
}

// Rows of a file and of the scene are the same scene: what is run, and its hash, do not
// depend on the file any more.
TEST(FieldFiles, become_rows_of_the_scene) {
    const Scene s = complete("spatial.yaml");
    const auto& table = std::get<VectorTable>(s.magnetic_field->plus[2].law);
    EXPECT_EQ(table.time_s, (std::vector{0.0, 0.05, 0.1}));
    ASSERT_EQ(table.vector_t.size(), 3u);
    EXPECT_EQ(table.vector_t[1], (Vec3{1.5e-3, 1e-3, 2e-5}));
    EXPECT_TRUE(table.repeat);
    EXPECT_EQ(table.source, (test_folder / "complete/field.csv").string());
    const Scene rows = read_scene(
        test_folder / "complete/spatial.yaml",
        {"magnetic_field.plus.2={vector_table: {time: [0 s, 50 ms, 100 ms], repeat: "
         "true, vector: [[0 T, 0 T, 0 T], [1.5 mT, 1 mT, 20 uT], [0 T, 0 T, 0 T]]}}"});
    EXPECT_EQ(rows.hash, s.hash);
}

TEST(Keys, of_sources_of_the_field) {
    const auto sources = complete("spatial.yaml").magnetic_field->sources;
    ASSERT_EQ(sources.size(), 7u);
    const FieldSource& arm = sources[0];
    EXPECT_EQ(arm.name, "arm");
    EXPECT_EQ(std::get<CuboidMagnet>(arm.shape).size_m, (Vec3{8e-3, 6e-3, 4e-3}));
    EXPECT_EQ(std::get<CuboidMagnet>(arm.shape).remanence_t, (Vec3{0, 0.2, 1.2}));
    EXPECT_EQ(arm.position_m, (Vec3{0, 0, 40e-3}));
    EXPECT_EQ(arm.rotation->axis, (Vec3{0, 1, 0}));
    EXPECT_EQ(std::get<SourcePath>(*arm.motion).displacement_m[1], (Vec3{5e-3, 0, 0}));
    EXPECT_EQ(std::get<double>(arm.turning->turns), 2);
    EXPECT_EQ(*arm.turning->about_m, (Vec3{1e-3, 0, 0}));
    const auto& coil = std::get<CircularCoil>(sources[1].shape);
    EXPECT_EQ(coil.diameter_m, 20e-3);
    EXPECT_EQ(coil.axis, (Vec3{0, 1, 0}));
    EXPECT_EQ(coil.current_a * coil.turns, 100);
    EXPECT_EQ(std::get<StrengthOscillation>(*sources[1].strength).frequency_hz, 3);
    const auto& drum = std::get<CylinderMagnet>(sources[2].shape);
    EXPECT_EQ(drum.height_m, 10e-3);
    EXPECT_EQ(drum.axis, (Vec3{1, 0, 0}));
    const auto& pair = std::get<CoilPair>(sources[3].shape);
    EXPECT_EQ(pair.distance_m, 50e-3);
    EXPECT_TRUE(pair.opposed);
    EXPECT_EQ(std::get<StrengthRamp>(*sources[3].strength).duration_s, 1);
    EXPECT_EQ(std::get<GridField>(sources[4].shape).file,
              (test_folder / "complete/grid.csv").string());
    EXPECT_EQ(std::get<DipoleSource>(sources[5].shape).moment_a_m2, (Vec3{0, 0, 0.1}));
    const auto& system = std::get<CoilSystem>(sources[6].shape);
    ASSERT_EQ(system.coils.size(), 2u);
    EXPECT_EQ(system.coils[1].current_a, (std::vector{1.0, 0.0, 1.0}));
    EXPECT_EQ(system.coils[1].position_m, (Vec3{0, 50e-3, 0}));
    EXPECT_EQ(system.time_s.size(), 3u);
}

// What data sheets give means the same as what the solvers take.
TEST(DataSheets, GiveTheSameScene) {
    const auto of = [](const std::vector<std::string>& sets) {
        return read_scene(test_folder / "minimal.yaml", sets);
    };
    const Scene usual =
        of({"bodies.robot.material={shear_modulus: 40 kPa, "
            "lame_lambda: 160 kPa, density: 1860 kg/m3}"});
    // E = G (3 K + 2 G) / (K + G) = 112 kPa, nu = K / (2 (K + G)) = 0.4.
    const Scene sheet =
        of({"bodies.robot.material={youngs_modulus: 112 kPa, "
            "poissons_ratio: 0.4, density: 1860 kg/m3}"});
    EXPECT_NEAR(sheet.bodies[0].material.shear_modulus_pa / 40e3, 1, 1e-15);
    EXPECT_NEAR(sheet.bodies[0].material.lame_lambda_pa / 160e3, 1, 1e-15);
    EXPECT_EQ(of({"fluid.viscosity=", "fluid.dynamic_viscosity=1 mPa s"}).hash,
              of({"fluid.viscosity=1 mm2/s"}).hash);
    const Scene remanent =
        of({"bodies.robot.magnetization={uniform: [78 mT, 0 A/m, 0 A/m]}"});
    const auto& uniform =
        std::get<UniformMagnetization>(*remanent.bodies[0].magnetization);
    EXPECT_NEAR(uniform.vector_a_m[0] / (78e-3 / (4e-7 * pi)), 1, 1e-15);
}

// A controller's text may name files beside the scene, and what it does not name stays.
TEST(Keys, of_a_controllers_text) {
    const Scene scene = read_scene(test_folder / "complete/spatial.yaml");
    const std::string grid = (test_folder / "complete/grid.csv").string();
    const auto file = [&](const std::string& text, std::size_t source) {
        const auto field = read_field("magnetic_field: {" + text + "}", "step", scene);
        return std::get<GridField>(field.sources.at(source).shape).file;
    };
    EXPECT_EQ(file("sources: {map: {grid: {file: grid.csv}}}", 0), grid);
    EXPECT_EQ(file("constant: {magnitude: 1 mT, direction: 0 deg}", 4), grid);
}

TEST(Keys, of_a_controller) {
    const Control control = *complete("spatial.yaml").control;
    EXPECT_TRUE(control.script.ends_with("steer.py"));
    EXPECT_EQ(control.every_s, 2e-3);
    ASSERT_EQ(control.probes.size(), 1u);
    EXPECT_EQ(control.probes.front(), "strip.com_x");
    EXPECT_EQ(control.timeout_s, 10);
}

}  // namespace
}  // namespace magfsi::scene
