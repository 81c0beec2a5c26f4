// SPDX-License-Identifier: GPL-2.0-or-later
// The scene files of these tests.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/checks.h"

namespace magfsi::scene {

inline const std::filesystem::path test_folder = MAGFSI_SCENE_TESTS;
inline const std::filesystem::path source_folder = MAGFSI_SOURCE;

// Scenes that are right; together they have every key of the table.
inline std::vector<std::filesystem::path> right_scenes() {
    return {test_folder / "complete/swimmer.yaml",
            test_folder / "complete/elastic.yaml",
            test_folder / "complete/turning.yaml",
            test_folder / "complete/spatial.yaml",
            test_folder / "minimal.yaml",
            source_folder / "tutorials/swimmer/scene.yaml",
            source_folder / "tutorials/swimmer/uniform.yaml",
            source_folder / "tutorials/swimmer/quick.yaml",
            source_folder / "tutorials/swimmer/paper.yaml"};
}

// A scene file of that text, removed when it goes out of scope.
class TemporaryScene {
  public:
    explicit TemporaryScene(const std::string& text) { std::ofstream(path_) << text; }
    const std::filesystem::path& path() const { return path_; }

  private:
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "scene.yaml";
};

}  // namespace magfsi::scene
