// SPDX-License-Identifier: GPL-2.0-or-later
// One input of the fuzzer, read as a scene.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"

namespace magfsi::scene {

// bytes: a scene file's text, and after a zero byte each one more word of --set. Either
// it is read, or it is refused with a SceneError; whatever else happens is a finding.
inline void read_input(const std::string& bytes, const std::filesystem::path& folder) {
    std::vector<std::string> words(1);
    for (const char c : bytes) {
        if (c == '\0')
            words.emplace_back();
        else
            words.back() += c;
    }
    const auto file = folder / "scene.yaml";
    std::ofstream(file, std::ios::binary) << words.front();
    words.erase(words.begin());
    try {
        const Scene scene = read_scene(file, words);
        effects_by_step(scene);
        idle_effects(scene);
    } catch (const SceneError&) {
    }
}

}  // namespace magfsi::scene
