// SPDX-License-Identifier: GPL-2.0-or-later
// From a YAML file to a Scene. Every fault is a SceneError with one message.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"

namespace magfsi::scene {

// what(): "file:line:column: what was found; what is allowed; suggestion", one line.
class SceneError : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

// path: a scene file, or a tutorial folder (its scene.yaml). overrides: as given to
// --set, "path.to.key=value"; a fault in one is reported as "--set path.to.key: ...".
Scene read_scene(const std::filesystem::path& path,
                 const std::vector<std::string>& overrides = {});

// What stands under magnetic_field of the scene, from a text {"magnetic_field": ...} that
// a controller returns (in YAML); what the text leaves out is the scene's. source: for
// the error. Throws SceneError.
MagneticField read_field(const std::string& text, const std::string& source,
                         const Scene& scene);

// The file that read_scene would open.
std::filesystem::path scene_file(const std::filesystem::path& path);

}  // namespace magfsi::scene
