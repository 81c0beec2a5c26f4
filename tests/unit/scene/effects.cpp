// Each effect is either active or absent, in the order of a step.
#include <gtest/gtest.h>

#include "coupler/scene/effective.h"
#include "coupler/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

using Names = std::vector<std::string>;

TEST(Effects, of_a_swimmer) {
    const Scene s = read_scene(test_folder / "complete/swimmer.yaml");
    EXPECT_EQ(active_effects(s), (Names{"elasticity", "magnetic field", "gravity",
                                        "damping", "clamps", "immersed boundary", "fluid",
                                        "body force", "moving walls", "checkpoint"}));
    EXPECT_EQ(absent_effects(s),
              (Names{"viscosity", "field gradient", "platform", "friction", "contact",
                     "rollers", "prescribed motion", "eddy viscosity",
                     "inlets and outlets", "obstacles"}));
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
    EXPECT_EQ(absent_effects(s),
              (Names{"viscosity", "field gradient", "gravity", "damping", "platform",
                     "friction", "contact", "clamps", "rollers", "prescribed motion",
                     "immersed boundary", "fluid", "body force", "eddy viscosity",
                     "moving walls", "inlets and outlets", "obstacles", "checkpoint"}));
}

TEST(Effects, of_faces_that_are_held) {
    EXPECT_EQ(active_effects(read_scene(test_folder / "complete/elastic.yaml")),
              (Names{"elasticity", "magnetic field", "clamps", "rollers",
                     "prescribed motion"}));
}

TEST(Effects, of_a_channel) {
    EXPECT_EQ(active_effects(read_scene(test_folder / "complete/channel.yaml")),
              (Names{"fluid", "eddy viscosity", "inlets and outlets", "obstacles"}));
}

TEST(Effects, of_a_fluid) {
    const Scene s = read_scene(test_folder / "minimal.yaml",
                               {"bodies=", "magnetic_field=", "gravity="});
    EXPECT_EQ(active_effects(s), Names{"fluid"});
}

}  // namespace
}  // namespace magfsi::scene
