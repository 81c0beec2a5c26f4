// SPDX-License-Identifier: GPL-2.0-or-later
// Right scenes are read, wrong and mutated ones refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"
#include "tests/support/checks.h"
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

TEST(CoupledStep, of_the_swimmer_follows_from_the_finest_cells) {
    const auto folder = source_folder / "tutorials/swimmer";
    EXPECT_NEAR(*coupled_step_s(read_scene(folder)), 25e-6 / 3, 1e-15);
    EXPECT_DOUBLE_EQ(*coupled_step_s(read_scene(folder / "uniform.yaml")), 20e-6);
}

// Each file in wrong/ has one fault; its first line says where and what the message
// holds:
// "# expect: LINE:COLUMN fragment".

std::vector<std::filesystem::path> wrong_scenes() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(test_folder / "wrong"))
        files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::string error_of(const std::filesystem::path& file) {
    return test::message_of<SceneError>([&] { read_scene(file); });
}

class WrongScene : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(WrongScene, is_refused_at_the_fault) {
    const std::string first =
        test::read(GetParam()).substr(0, test::read(GetParam()).find('\n'));
    const std::string head = "# expect: ";
    ASSERT_TRUE(first.starts_with(head)) << GetParam();
    const std::string expected = first.substr(head.size());
    const std::string place = expected.substr(0, expected.find(' '));
    const std::string fragment = expected.substr(expected.find(' ') + 1);
    ASSERT_GE(fragment.size(), 3u);

    const std::string message = error_of(GetParam());
    EXPECT_TRUE(message.starts_with(GetParam().string() + ":" + place + ": found "))
        << message;
    test::expect_says(message, {fragment});
}

TEST_P(WrongScene, is_told_in_one_line_with_what_is_allowed) {
    const std::string message = error_of(GetParam());
    const std::string rest = message.substr(GetParam().string().size());
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    test::expect_says(message, {"; allowed "});
    // :LINE:COLUMN: and no control characters
    EXPECT_EQ(rest.find_first_not_of("0123456789:"), rest.find(" found "));
    EXPECT_EQ(std::ranges::count(rest.substr(0, rest.find(' ')), ':'), 3);
}

INSTANTIATE_TEST_SUITE_P(all, WrongScene, testing::ValuesIn(wrong_scenes()),
                         [](const auto& file) { return file.param.stem().string(); });

TEST(WrongScenes, are_many) {
    EXPECT_GE(wrong_scenes().size(), 100u);
}

TEST(MissingFile, is_named) {
    EXPECT_EQ(
        error_of("no/such.yaml"),
        "no/such.yaml: found no such file; allowed a scene file, or a folder with a "
        "scene.yaml");
    const std::string folder = error_of(test_folder / "wrong");
    EXPECT_TRUE(
        folder.starts_with((test_folder / "wrong/scene.yaml").string() + ": found"));
}

TEST(Messages, keep_to_one_line_whatever_the_file_holds) {
    const TemporaryScene scene("time: {end: \"a\\nb\\tc\"}\nfluid: {}\n");
    const std::string message = error_of(scene.path());
    EXPECT_EQ(message.find_first_of("\n\t"), std::string::npos) << message;
    test::expect_says(message, {":1:13: found \"a b c\""});
}

// Aliases of aliases of aliases: ten to the ninth nodes if they were all expanded.
TEST(Messages, stop_at_exploding_aliases) {
    std::string text = "a0: &a0 [1]\n";
    for (int i = 1; i < 10; ++i) {
        std::ostringstream line;
        line << "a" << i << ": &a" << i << " [";
        for (int k = 0; k < 10; ++k) line << (k ? ", *a" : "*a") << i - 1;
        text += line.str() + "]\n";
    }
    const TemporaryScene scene(text);
    test::expect_says(error_of(scene.path()), {"more than 200000 nodes"});
}

// Whatever is typed into a scene, the answer is a scene or a SceneError of one line with
// its place: no other exception, no crash.

// 1 if the text was refused.
int refused(const std::string& text) {
    const TemporaryScene scene(text);
    try {
        read_scene(scene.path());
        return 0;
    } catch (const SceneError& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with(scene.path().string() + ":")) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return 1;
    }
}

std::string original() {
    return test::read(test_folder / "complete/swimmer.yaml");
}

TEST(Mutation, of_one_character) {
    const std::string text = original();
    int faults = 0, tries = 0;
    // A prime step visits all kinds of places in a second.
    for (std::size_t at = 0; at < text.size(); at += 7) {
        for (const char typed : {'x', '9', '-', ':', '{', ']', '\n', '\t', '&', '\0'}) {
            std::string mutated = text;
            mutated[at] = typed;
            faults += refused(mutated);
            ++tries;
        }
    }
    // Most places hold a key, a number or a bracket; comments and names are the rest.
    EXPECT_GT(faults, tries / 2);
}

TEST(Mutation, by_leaving_out_a_line) {
    const std::string text = original();
    int faults = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin) + 1;
        faults += refused(text.substr(0, begin) + text.substr(end));
        begin = end;
    }
    EXPECT_GT(faults, 10);
}

TEST(Mutation, by_cutting_the_file_short) {
    const std::string text = original();
    int faults = 0;
    for (std::size_t size = 0; size < text.size(); size += 13)
        faults += refused(text.substr(0, size));
    EXPECT_GT(faults, 50);
}

TEST(Mutation, by_nesting_without_end) {
    EXPECT_EQ(refused(std::string(20000, '[')), 1);
    EXPECT_EQ(refused("fluid: " + std::string(5000, '{')), 1);
    EXPECT_EQ(refused(std::string("time: \xff\xfe\x00\x01", 10)), 1);
}

}  // namespace
}  // namespace magfsi::scene
