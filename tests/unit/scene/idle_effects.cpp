// An effect that is in the scene and can do nothing there is told of; one that does
// something is not.
#include <gtest/gtest.h>

#include <algorithm>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

using Sets = std::vector<std::string>;

std::string warnings(const std::string& file, const Sets& overrides) {
    std::string all;
    for (const auto& line : idle_effects(read_scene(test_folder / file, overrides)))
        all += line + "\n";
    return all;
}

std::string of_minimal(const Sets& overrides) {
    return warnings("minimal.yaml", overrides);
}

TEST(IdleEffects, are_not_seen_where_there_are_none) {
    for (const auto& file : right_scenes()) {
        const auto idle = idle_effects(read_scene(file));
        EXPECT_TRUE(idle.empty()) << file << ": " << idle.front();
    }
}

struct Case {
    const char* warning;  // what it begins with, and why
    Sets overrides;
};

TEST(IdleEffects, are_named_with_the_reason) {
    const std::string gradient =
        "magnetic_field.gradient.matrix=[[0 T/m, 0 T/m, 0 T/m], [0 T/m, 0 T/m, 0 T/m], "
        "[0 T/m, 0 T/m, 0 T/m]]";
    const std::vector<Case> cases{
        {"gravity can do nothing: its acceleration is 0",
         {"gravity.acceleration=0 m/s2"}},
        {"gravity can do nothing: every body has the fluid's density",
         {"bodies.robot.material.density=1000 kg/m3"}},
        {"magnetic_field can do nothing: its magnitude is 0 at all times",
         {"magnetic_field.table.magnitude=[0 T]"}},
        {"magnetic_field can do nothing: every magnetization is 0",
         {"bodies.robot.magnetization={uniform: [0 A/m, 0 A/m, 0 A/m]}"}},
        {"magnetic_field.gradient can do nothing: its matrix is 0", {gradient}},
        {"damping can do nothing: its rate is 0", {"damping.rate=0 1/s"}},
        {"fluid.body_force can do nothing: it is 0",
         {"fluid.body_force=[0 N/m3, 0 N/m3, 0 N/m3]"}},
        {"fluid.initial_velocity can do nothing: it is 0",
         {"fluid.initial_velocity=[0 m/s, 0 m/s, 0 m/s]"}},
        {"checkpoint can do nothing: its interval is longer than the run",
         {"checkpoint.every=2 s"}},
    };
    for (const Case& c : cases) {
        const std::string text = of_minimal(c.overrides);
        EXPECT_TRUE(text.starts_with(c.warning)) << text << "instead of " << c.warning;
        EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;
    }
}

TEST(IdleEffects, of_an_equilibrium_by_newton_are_those_of_motion) {
    EXPECT_TRUE(
        warnings("complete/turning.yaml",
                 {"time={end: 1 s, equilibrium: {method: newton}}", "damping.rate=5 1/s"})
            .starts_with("damping can do nothing: Newton's method"));
}

}  // namespace
}  // namespace magfsi::scene
