// Spacing and elements for a scene that says how accurate or how long it is to be.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "adapters/magfsi/accuracy/cover.h"
#include "adapters/magfsi/ranks.h"

namespace magfsi::launch {

struct Choice {
    std::vector<std::string> settings;  // in place of the key accuracy, for --set
    std::vector<std::string> words;  // which study, why, what to expect: lines of a log
    nlohmann::ordered_json json;     // the same for summary.json
};

// Seconds of the scene with these settings; nothing where they cannot be predicted.
using WallTime =
    std::function<std::optional<double>(const std::vector<std::string>& settings)>;

// The study that covers the scene, and the resolution that it advises. Throws SceneError
// at the key accuracy if none covers the scene, or none of its resolutions is enough.
Choice choose(const scene::Unresolved& unresolved, const WallTime& wall_s);

// For a scene file without the key accuracy, nothing.
std::optional<Choice> resolve_accuracy(const std::filesystem::path& scene,
                                       const std::vector<std::string>& overrides,
                                       const Ranks& ranks);

}  // namespace magfsi::launch
