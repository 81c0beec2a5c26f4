// The scene files of these tests.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace magfsi::scene {

inline const std::filesystem::path test_folder = MAGFSI_SCENE_TESTS;
inline const std::filesystem::path source_folder = MAGFSI_SOURCE;

// Scenes that are right; together they have every key of the table.
inline std::vector<std::filesystem::path> right_scenes() {
    return {test_folder / "complete/swimmer.yaml",
            test_folder / "complete/elastic.yaml",
            test_folder / "complete/turning.yaml",
            test_folder / "minimal.yaml",
            source_folder / "tutorials/swimmer/scene.yaml",
            source_folder / "tutorials/swimmer/paper.yaml"};
}

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// A scene file of that text, removed when it goes out of scope.
class TemporaryScene {
  public:
    explicit TemporaryScene(const std::string& text) {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("magfsi_scene_" + std::to_string(::getpid()) + "_" +
                 std::to_string(count++) + ".yaml");
        std::ofstream(path_) << text;
    }
    ~TemporaryScene() { std::filesystem::remove(path_); }
    TemporaryScene(const TemporaryScene&) = delete;
    TemporaryScene& operator=(const TemporaryScene&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace magfsi::scene
