// SPDX-License-Identifier: GPL-2.0-or-later
// A scene that is kept in a run folder is the same scene when it is read from there.
#include "adapters/scene/kept_scene.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"
#include "tests/support/checks.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

namespace fs = std::filesystem;

// Writes what is kept to a folder, as a run does.
void keep(const KeptScene& kept, const fs::path& folder) {
    std::ofstream(folder / "scene.yaml") << kept.complete;
    for (const KeptFile& file : kept.files) {
        fs::create_directories((folder / file.name).parent_path());
        // Some complete scenes name a mesh that is not there.
        if (fs::exists(file.from)) fs::copy_file(file.from, folder / file.name);
    }
}

// All keys that complete scenes have, those with files among them.
std::vector<fs::path> scenes() {
    std::vector<fs::path> found = right_scenes();
    for (const auto& entry : fs::directory_iterator(test_folder / "complete"))
        if (entry.path().extension() == ".yaml") found.push_back(entry.path());
    for (const char* name : {"catheter", "gripper", "steering", "tank", "cilia"})
        found.push_back(source_folder / "tutorials" / name / "scene.yaml");
    return found;
}

TEST(KeptScene, IsTheSameSceneWithoutTheOriginal) {
    for (const fs::path& file : scenes()) {
        SCOPED_TRACE(file);
        const std::vector<std::string> overrides{"name=kept"};
        const Scene scene = read_scene(file, overrides);
        const test::TemporaryFolder folder;
        keep(kept_scene(file, overrides, scene), folder / "");
        const Scene again = read_scene(folder / "");
        EXPECT_EQ(state_hash(again), state_hash(scene));
        EXPECT_EQ(again.name, "kept");
        EXPECT_TRUE(files_elsewhere(again).empty());
    }
}

TEST(KeptScene, HasTheTextAsGivenWhereNothingChangesIt) {
    const fs::path file = test_folder / "minimal.yaml";
    const KeptScene kept = kept_scene(file, {}, read_scene(file));
    EXPECT_EQ(kept.complete, kept.as_given);
    EXPECT_EQ(kept.complete, file_text(file));
    EXPECT_TRUE(kept.files.empty());
}

// A scene that is kept, kept once more: nothing is renamed.
TEST(KeptScene, IsKeptAsItIs) {
    const fs::path file = source_folder / "tutorials/gripper/scene.yaml";
    const test::TemporaryFolder folder;
    keep(kept_scene(file, {}, read_scene(file)), folder / "");
    const KeptScene again = kept_scene(folder / "", {}, read_scene(folder / ""));
    EXPECT_EQ(again.complete, again.as_given);
    EXPECT_FALSE(again.files.empty());
}

TEST(KeptScene, FilesOfOneNameStayApart) {
    const test::TemporaryFolder folder;
    for (const char* side : {"left", "right"}) {
        fs::create_directories(folder / side);
        fs::copy_file(source_folder / "tutorials/gripper/ball.msh",
                      folder / side / "ball.msh");
    }
    std::ofstream(folder / "right/ball.msh", std::ios::app) << "\n";
    const std::string body =
        "{mesh: {gmsh: {file: %/ball.msh}}, material: {shear_modulus: 33 kPa, "
        "lame_lambda: 660 kPa, density: 1860 kg/m3}, initial: {position: [0 m, 0 m, @]}}";
    const auto of = [&](const std::string& side, const std::string& z) {
        std::string text = body;
        text.replace(text.find('%'), 1, side);
        return text.replace(text.find('@'), 1, z);
    };
    const fs::path file = folder / "two.yaml";
    std::ofstream(file) << "name: two\ntime: {end: 1 ms}\nbodies:\n  a: "
                        << of("left", "0 m") << "\n  b: " << of("right", "50 mm") << "\n";
    const KeptScene kept = kept_scene(file, {}, read_scene(file));
    ASSERT_EQ(kept.files.size(), 2U);
    EXPECT_EQ(kept.files[0].name, "scene_files/ball.msh");
    EXPECT_EQ(kept.files[1].name, "scene_files/2-ball.msh");
    EXPECT_EQ(kept.files[1].from.parent_path().filename(), "right");
}

TEST(KeptScene, WordsThatYamlWouldTakeForOthersAreQuoted) {
    const std::string text =
        "a: \"null\"\nb: \"\"\nc: ~\nd: \"two\\nlines\"\ne: \"# none\"\n"
        "f: [1 mm, \"x, y\", \'it\'\'s\']\ng: \"{}\"\nh: {}\ni: []\n"
        "j: \"key: value\"\nk: \" blank \"\nl: µm\nm: [[1, 2], [3, 4]]\n";
    const Node node = parse_document(text, {"text", 1, 1});
    const Node again = parse_document(to_yaml(node), {"again", 1, 1});
    ASSERT_EQ(again.children.size(), node.children.size());
    for (std::size_t i = 0; i < node.children.size(); ++i) {
        EXPECT_EQ(again.children[i].key, node.children[i].key);
        EXPECT_EQ(again.children[i].type, node.children[i].type) << node.children[i].key;
        EXPECT_EQ(again.children[i].scalar, node.children[i].scalar);
        ASSERT_EQ(again.children[i].children.size(), node.children[i].children.size());
        for (std::size_t j = 0; j < node.children[i].children.size(); ++j)
            EXPECT_EQ(again.children[i].children[j].scalar,
                      node.children[i].children[j].scalar);
    }
}

// A restart knows a scene by what its files hold.
TEST(StateHash, IsThatOfTheFilesContent) {
    const fs::path file = source_folder / "tutorials/catheter/scene.yaml";
    const Scene scene = read_scene(file);
    const test::TemporaryFolder folder;
    const KeptScene kept = kept_scene(file, {}, scene);
    keep(kept, folder / "");
    EXPECT_EQ(state_hash(read_scene(folder / "")), state_hash(scene));
    std::ofstream(folder / kept.files.front().name, std::ios::app) << " ";
    EXPECT_NE(state_hash(read_scene(folder / "")), state_hash(scene));
}

}  // namespace
}  // namespace magfsi::scene
