// What only looks like a fault is accepted.
#include <gtest/gtest.h>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

TEST(RightScene, is_each_tutorial_and_example) {
    for (const auto& file : right_scenes()) EXPECT_NO_THROW(read_scene(file)) << file;
}

TEST(RightScene, of_a_tutorial_is_found_by_its_folder) {
    const auto folder = source_folder / "tutorials/swimmer";
    EXPECT_EQ(scene_file(folder), folder / "scene.yaml");
    EXPECT_EQ(read_scene(folder).hash, read_scene(folder / "scene.yaml").hash);
    EXPECT_NE(read_scene(folder).hash, read_scene(folder / "paper.yaml").hash);
}

TEST(RightScene, may_touch_the_walls) {
    const auto minimal = test_folder / "minimal.yaml";
    // Half the body is 2 mm long and 0.1 mm thick.
    EXPECT_NO_THROW(
        read_scene(minimal, {"bodies.robot.initial.position=[2 mm, 4 mm, 0.1 mm]"}));
    // Turned by 90 degrees, cos of which is not 0 but 6e-17.
    EXPECT_NO_THROW(
        read_scene(minimal, {"bodies.robot.initial.position=[0.1 mm, 4 mm, 2 mm]",
                             "bodies.robot.initial.rotation.angle=90 deg"}));
}

TEST(RightScene, may_have_cells_that_fit_but_for_rounding) {
    // 1 / 3 of 16 mm to ten digits divides the box within 1e-6.
    EXPECT_NO_THROW(
        read_scene(test_folder / "minimal.yaml",
                   {"fluid.spacing=0.3333333333 mm", "fluid.box=[16 mm, 8 mm, 5 mm]"}));
}

TEST(RightScene, may_have_mean_f_edges_equal_to_the_thickness) {
    EXPECT_NO_THROW(read_scene(
        test_folder / "minimal.yaml",
        {"bodies.robot.element=mean_f", "bodies.robot.mesh.box.elements=[20, 10, 1]"}));
}

TEST(RightScene, may_be_a_fluid_alone) {
    const Scene s = read_scene(test_folder / "minimal.yaml",
                               {"bodies=", "magnetic_field=", "gravity="});
    EXPECT_FALSE(s.coupling);
    EXPECT_TRUE(s.bodies.empty());
}

// The viscosity that bounds the lattice Boltzmann method says nothing about OpenFOAM.
TEST(RightScene, of_openfoam_has_no_relaxation_time) {
    EXPECT_NO_THROW(
        read_scene(test_folder / "minimal.yaml",
                   {"fluid.solver=openfoam", "fluid.viscosity=0.0001 mm2/s"}));
    EXPECT_THROW(
        read_scene(test_folder / "minimal.yaml", {"fluid.viscosity=0.0001 mm2/s"}),
        SceneError);
}

TEST(CoupledStep, is_the_given_one_or_that_of_the_lattice_speed) {
    const auto minimal = test_folder / "minimal.yaml";
    // 0.05 * 1 mm / 0.5 m/s, to the rounding of two operations.
    EXPECT_DOUBLE_EQ(*coupled_step_s(read_scene(minimal)), 1e-4);
    EXPECT_DOUBLE_EQ(*coupled_step_s(read_scene(minimal, {"fluid.solver=openfoam"})),
                     4e-4);
    EXPECT_EQ(coupled_step_s(read_scene(minimal, {"time.step=50 us"})), 5e-5);
    EXPECT_EQ(coupled_step_s(read_scene(test_folder / "complete/elastic.yaml")),
              std::nullopt);
    EXPECT_EQ(coupled_step_s(read_scene(test_folder / "complete/turning.yaml")), 1e-3);
}

TEST(CoupledStep, of_the_swimmer_is_twenty_microseconds) {
    EXPECT_DOUBLE_EQ(*coupled_step_s(read_scene(source_folder / "tutorials/swimmer")),
                     20e-6);
}

}  // namespace
}  // namespace magfsi::scene
