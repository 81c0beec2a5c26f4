// accuracy: {error: 3 %} or {time: 10 min}: a scene whose resolution is still to be
// chosen.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "adapters/scene/document.h"
#include "adapters/scene/scene.h"

namespace magfsi::scene {

struct Accuracy {
    std::optional<double> error;   // relative; or
    std::optional<double> time_s;  // of the run
};

// The scene with placeholders for what is to be chosen, checked key by key only.
struct Unresolved {
    Accuracy wanted;
    Scene scene;
    bool spacing = false;             // to be chosen
    std::vector<std::string> meshes;  // blocks whose elements are
    Origin mark;                      // of the key accuracy
};

// Nothing if the scene has no key accuracy. Throws SceneError, also if spacing and all
// elements are given beside it. What is chosen then goes into overrides, with
// "accuracy=null", and the scene is read anew.
std::optional<Unresolved> read_unresolved(const std::filesystem::path& path,
                                          const std::vector<std::string>& overrides);

// Of reader.cpp: the parts of read_scene.
Node read_tree(const std::filesystem::path& file,
               const std::vector<std::string>& overrides);
Scene unchecked_scene(const Node& root, const std::filesystem::path& folder);

}  // namespace magfsi::scene
