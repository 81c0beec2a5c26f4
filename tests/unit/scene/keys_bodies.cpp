// SPDX-License-Identifier: GPL-2.0-or-later
// Keys of bodies that reach their members: rubber, rigid parts, shapes.
#include <gtest/gtest.h>

#include <numbers>

#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

Scene complete(const char* name) {
    return read_scene(test_folder / "complete" / name);
}

TEST(Keys, of_rubber) {
    const Scene s = complete("rubber.yaml");
    EXPECT_EQ(s.time.start, RunStart::equilibrium);
    const Body& bar = s.bodies.at(0);
    EXPECT_EQ(std::get<Gent>(*bar.material.stiffening).limit, 5);
    EXPECT_EQ(bar.material.branches,
              (std::vector<MaxwellBranch>{{20e3, 10e-3}, {5e3, 1}}));
    // A preset, one constant of which is replaced.
    const Material& preset = bar.material_regions.at(0).material;
    EXPECT_EQ(preset.density_kg_m3, 960);
    EXPECT_EQ(preset.shear_modulus_pa, 15.63e3);
    EXPECT_EQ(std::get<ArrudaBoyce>(*preset.stiffening).locking_stretch, 5.85);
    EXPECT_EQ(preset.branches.size(), 3u);
    EXPECT_EQ(std::get<Yeoh>(*bar.material_regions.at(1).material.stiffening),
              (Yeoh{-1e3, 500}));
    EXPECT_EQ(bar.magnetization->follows, MagnetizationFollows::rotation);
    EXPECT_EQ(
        std::get<HeldDisplacement>(bar.prescribed_motion.at(0).course).displacement_m,
        (Vec3{1e-4, 0, -2e-6}));
    EXPECT_EQ(std::get<ArrudaBoyce>(*s.bodies.at(1).material.stiffening).locking_stretch,
              3);
}

TEST(Keys, of_rigid_parts_and_round_bodies) {
    const auto bodies = complete("rigid.yaml").bodies;
    ASSERT_EQ(bodies.size(), 9u);  // by the alphabet
    EXPECT_EQ(bodies[0].rigid, std::vector<std::string>{"tip"});
    EXPECT_FALSE(bodies[0].is_all_rigid());
    EXPECT_TRUE(bodies[1].is_all_rigid());
    EXPECT_EQ(bodies[1].material.shear_modulus_pa, 0);
    EXPECT_EQ(std::get<BallMesh>(bodies[1].mesh), (BallMesh{2e-3, {4, 2}}));
    EXPECT_EQ(std::get<Pivot>(*bodies[1].hold).about_m, (Vec3{1e-3, 2e-3, 3e-3}));
    EXPECT_NEAR((*bodies[1].initial.angular_velocity_rad_s)[0], std::numbers::pi / 2,
                1e-15);
    EXPECT_EQ(std::get<CapsuleMesh>(bodies[2].mesh),
              (CapsuleMesh{1e-3, 3e-3, {2, 1, 4}}));
    EXPECT_EQ(bodies[2].initial.velocity_m_s, (Vec3{1e-3, 2e-3, 3e-3}));
    EXPECT_EQ(std::get<CylinderMesh>(bodies[3].mesh),
              (CylinderMesh{0.5e-3, 3e-3, {1, 1, 6}}));
    EXPECT_EQ(std::get<Hinge>(*bodies[3].hold).axis, (Vec3{0, 0, 2}));
    EXPECT_EQ(std::get<Hinge>(*bodies[3].hold).about_m, (Vec3{4e-3, 5e-3, 6e-3}));
    EXPECT_TRUE(bodies[6].rigid.empty());
    EXPECT_EQ(std::get<ConeMesh>(bodies[6].mesh),
              (ConeMesh{{1e-3, 0.2e-3}, 2e-3, {2, 1, 5}}));
    EXPECT_EQ(
        std::get<WireMesh>(bodies[8].mesh),
        (WireMesh{0.5e-3, 1e-3, 3, 0.2e-3, {1, 1, 60}, true, WireHead{0.8e-3, 1e-3}}));
}

TEST(Keys, of_rigid_parts_in_prescribed_motion) {
    const auto bodies = complete("rigid.yaml").bodies;
    EXPECT_EQ(bodies[3].moved(), nullptr);
    const RigidCourse* hand = bodies[4].moved();
    ASSERT_NE(hand, nullptr);
    EXPECT_EQ(
        structure::value_at(std::get<FormulaMotion>(*hand->way).component_m[1].si, 0.5),
        1e-3);
    EXPECT_EQ(hand->turning->axis, (Vec3{1, 2, 2}));
    EXPECT_EQ(hand->turning->about_m, (Vec3{1e-3, 2e-3, 3e-3}));
    EXPECT_EQ(structure::value_at(std::get<Formula>(hand->turning->angle).si, 0.5), 5);
    const RigidCourse* lid = bodies[5].moved();
    EXPECT_EQ(std::get<DisplacementRamp>(*lid->way).duration_s, 4e-3);
    EXPECT_FALSE(lid->turning);
    EXPECT_EQ(lid->courses().size(), 1u);
    const RigidCourse* rocker = bodies[7].moved();
    EXPECT_EQ(std::get<Oscillation>(*rocker->way).amplitude_m, (Vec3{1e-3, 2e-3, 3e-3}));
    EXPECT_EQ(std::get<AngleOscillation>(rocker->turning->angle).frequency_hz, 2);
    EXPECT_EQ(rocker->courses().size(), 2u);
}

TEST(Keys, of_shapes) {
    const auto bodies = complete("shapes.yaml").bodies;
    ASSERT_EQ(bodies.size(), 3u);  // by the alphabet
    const auto& cubes = std::get<VoxelMesh>(bodies[0].mesh);
    EXPECT_EQ(cubes.file, (test_folder / "complete/robot.stl").string());
    EXPECT_EQ(cubes.unit_m, 1e-3);
    EXPECT_EQ(cubes.spacing_m, 0.1e-3);
    ASSERT_EQ(cubes.faces.size(), 1u);
    EXPECT_EQ(cubes.faces[0].name, "tip");
    EXPECT_EQ(cubes.faces[0].box_m[1], (Vec3{4e-3, 5e-3, 6e-3}));
    const auto& arc = std::get<Arc>(bodies[1].mesh);
    EXPECT_EQ(arc.radius_m, 2e-3);
    EXPECT_NEAR(arc.angle_rad, std::numbers::pi / 2, 1e-15);
    EXPECT_EQ(arc.section_m, (std::array{1e-3, 0.2e-3}));
    EXPECT_EQ(arc.elements, (std::array{12, 3, 1}));
    const auto& helix = std::get<Helix>(bodies[2].mesh);
    EXPECT_EQ(helix.radius_m, 0.5e-3);
    EXPECT_EQ(helix.pitch_m, 2e-3);
    EXPECT_EQ(helix.turns, 1.5);
    EXPECT_EQ(helix.section_m, (std::array{0.3e-3, 0.2e-3}));
    EXPECT_EQ(helix.elements, (std::array{30, 2, 1}));
    EXPECT_TRUE(helix.left_handed);
    const auto& radial = std::get<RadialMagnetization>(*bodies[0].magnetization);
    EXPECT_EQ(radial.strength_a_m, -20e3);
    EXPECT_EQ(radial.centre_m, (Vec3{1e-3, 2e-3, 3e-3}));
    EXPECT_EQ(radial.axis, (Vec3{0, 0, 2}));
    const auto& curve = std::get<CurveMagnetization>(*bodies[1].magnetization);
    EXPECT_EQ(curve.strength_a_m, 62e3);
    EXPECT_EQ(curve.wavelength_m, 3e-3);
    EXPECT_NEAR(curve.phase_rad, std::numbers::pi / 4, 1e-15);
    EXPECT_EQ(curve.plane, (std::array{0, 1}));
    ASSERT_EQ(curve.points_m.size(), 2u);
    EXPECT_EQ(curve.points_m[1], (Vec3{1e-3, 0, 0}));
}

}  // namespace
}  // namespace magfsi::scene
