// Each effect is either active or absent, in the order of a step.
#include <gtest/gtest.h>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

using Names = std::vector<std::string>;

TEST(Effects, of_a_swimmer) {
    const Scene s = read_scene(test_folder / "complete/swimmer.yaml");
    EXPECT_EQ(active_effects(s),
              (Names{"elasticity", "magnetic field", "gravity", "damping", "clamps",
                     "immersed boundary", "buoyancy", "iterated forcing", "fluid",
                     "body force", "moving walls", "probes", "interface balance",
                     "energy audit", "structure fields", "fluid fields", "checkpoint"}));
    EXPECT_EQ(absent_effects(s),
              (Names{"viscosity", "field gradient", "platform", "friction", "contact",
                     "rollers", "prescribed motion", "parallel scheme", "implicit scheme",
                     "eddy viscosity", "free slip", "inlets and outlets", "obstacles"}));
}

TEST(Effects, of_a_strip_on_a_platform) {
    const Scene s = read_scene(test_folder / "complete/platform.yaml");
    EXPECT_EQ(active_effects(s),
              (Names{"elasticity", "viscosity", "magnetic field", "field gradient",
                     "platform", "friction", "contact"}));
}

TEST(Effects, of_a_solid) {
    const Scene s = read_scene(test_folder / "complete/turning.yaml");
    EXPECT_EQ(active_effects(s), (Names{"elasticity", "magnetic field"}));
    EXPECT_EQ(
        effects_by_step(s),
        (Names{
            "structure step: elasticity, magnetic field; absent: viscosity, "
            "field gradient, gravity, damping, platform, friction, contact, "
            "clamps, rollers, prescribed motion",
            "coupled step: none; absent: immersed boundary, buoyancy, iterated "
            "forcing, parallel scheme, implicit scheme",
            "fluid step: none; absent: fluid, body force, eddy viscosity, "
            "moving walls, free slip, inlets and outlets, obstacles",
            "outputs: none; absent: probes, interface balance, energy audit, structure "
            "fields, fluid fields, checkpoint"}));
}

TEST(Effects, of_faces_that_are_held) {
    EXPECT_EQ(active_effects(read_scene(test_folder / "complete/elastic.yaml")),
              (Names{"elasticity", "magnetic field", "clamps", "rollers",
                     "prescribed motion"}));
}

TEST(Effects, of_a_channel) {
    EXPECT_EQ(active_effects(read_scene(test_folder / "complete/channel.yaml")),
              (Names{"fluid", "eddy viscosity", "free slip", "inlets and outlets",
                     "obstacles", "probes"}));
}

TEST(Effects, of_a_fluid) {
    const Scene s = read_scene(test_folder / "minimal.yaml",
                               {"bodies=", "magnetic_field=", "gravity="});
    EXPECT_EQ(active_effects(s), (Names{"fluid", "probes", "fluid fields"}));
}

}  // namespace
}  // namespace magfsi::scene
