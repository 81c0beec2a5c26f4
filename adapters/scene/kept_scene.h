// SPDX-License-Identifier: GPL-2.0-or-later
// A scene as its run folder keeps it: complete in itself, so that the folder can be run
// again, on another machine, too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "adapters/scene/document.h"
#include "adapters/scene/scene.h"

namespace magfsi::scene {

// The folder of kept files, beside the scene.
constexpr const char* kept_files_folder = "scene_files";

// A file that the scene reads, and its name from the run folder on:
// scene_files/robot.stl.
struct KeptFile {
    std::filesystem::path from;
    std::string name;
};

struct KeptScene {
    // The text as given; and with the overrides and the names of the kept files, which is
    // the same text if neither changes it.
    std::string as_given, complete;
    std::vector<KeptFile> files;
};

// `path` and `overrides` as for read_scene, which has returned `scene`. Throws
// SceneError.
KeptScene kept_scene(const std::filesystem::path& path,
                     const std::vector<std::string>& overrides, const Scene& scene);

// The tree as YAML. Anchors stay expanded; comments are not in the tree.
std::string to_yaml(const Node& root);

}  // namespace magfsi::scene
