// SPDX-License-Identifier: GPL-2.0-or-later
// Reading of scenes. Every fault is reported as a SceneError with one message.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"

namespace magfsi::scene {

// A fault of the scene. what() is one line "file:line:column: what was found; what is
// allowed; suggestion".
class SceneError : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

// Reads, checks and completes a scene. `path` is a scene file or a folder with a
// scene.yaml. `overrides` are those of --set, "path.to.key=value"; a fault in one is
// reported as "--set path.to.key: ...". Throws SceneError.
Scene read_scene(const std::filesystem::path& path,
                 const std::vector<std::string>& overrides = {});

// Reads the magnetic field that a controller returns as YAML text {"magnetic_field":
// ...}. Keys that the text leaves out keep the scene's values, except `plus`, which is
// then empty. `source` names the text in errors. Throws SceneError.
MagneticField read_field(const std::string& text, const std::string& source,
                         const Scene& scene);

// The file that read_scene would open. Throws SceneError if it does not exist.
std::filesystem::path scene_file(const std::filesystem::path& path);
// The text of a scene file. Throws SceneError if it is too large, cannot be read, or is
// no regular file.
std::string file_text(const std::filesystem::path& file);

}  // namespace magfsi::scene
