// Each file in wrong/ has one fault; its first line says where and what the message
// holds:
// "# expect: LINE:COLUMN fragment".
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

std::vector<std::filesystem::path> wrong_scenes() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(test_folder / "wrong"))
        files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::string error_of(const std::filesystem::path& file) {
    try {
        read_scene(file);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no error";
}

class WrongScene : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(WrongScene, is_refused_at_the_fault) {
    const std::string first =
        text_of(GetParam()).substr(0, text_of(GetParam()).find('\n'));
    const std::string head = "# expect: ";
    ASSERT_TRUE(first.starts_with(head)) << GetParam();
    const std::string expected = first.substr(head.size());
    const std::string place = expected.substr(0, expected.find(' '));
    const std::string fragment = expected.substr(expected.find(' ') + 1);
    ASSERT_GE(fragment.size(), 3u);

    const std::string message = error_of(GetParam());
    EXPECT_TRUE(message.starts_with(GetParam().string() + ":" + place + ": found "))
        << message;
    EXPECT_NE(message.find(fragment), std::string::npos) << message;
}

TEST_P(WrongScene, is_told_in_one_line_with_what_is_allowed) {
    const std::string message = error_of(GetParam());
    const std::string rest = message.substr(GetParam().string().size());
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find("; allowed "), std::string::npos) << message;
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
    EXPECT_NE(message.find(":1:13: found \"a b c\""), std::string::npos) << message;
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
    EXPECT_NE(error_of(scene.path()).find("more than 200000 nodes"), std::string::npos);
}

}  // namespace
}  // namespace magfsi::scene
