// Whatever is typed into a scene, the answer is a scene or a SceneError of one line with
// its place: no other exception, no crash.
#include <gtest/gtest.h>

#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

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
    return text_of(test_folder / "complete/swimmer.yaml");
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
