// SPDX-License-Identifier: GPL-2.0-or-later
// Hashes by which scenes, and the states that they go through, are known again.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "adapters/scene/effective.h"
#include "adapters/scene/named_files.h"
#include "coupler/hash.h"

namespace magfsi::scene {

std::uint64_t scene_hash(const Scene& scene) {
    // nlohmann::json sorts its keys, unlike ordered_json.
    return coupler::hash_of(nlohmann::json(effective_scene(scene)).dump());
}

namespace {

// A file counts by its content, wherever it lies; a script, which is often mended between
// two starts, by its name.
std::string content_of(const std::string& file) {
    const std::filesystem::path path(file);
    std::ifstream in(path, std::ios::binary);
    if (!in || path.extension() == ".py") return path.filename().string();
    std::ostringstream text;
    text << in.rdbuf();
    return fmt::format("{:016x}", coupler::hash_of(text.str()));
}

}  // namespace

// Resets all options that change no state before the end of a run: its length, files,
// waiting times and the reactions to faults.
std::uint64_t state_hash(const Scene& scene) {
    Scene endless = scene;
    endless.time.end_s = 0;
    endless.report = PageAtEnd::on;
    // The reaction to a divergence changes no state before it.
    if (endless.checkpoint) endless.checkpoint = Checkpoint{endless.checkpoint->every_s};
    if (endless.coupling) {
        endless.coupling->timeout_s.reset();
        endless.coupling->overlap = {};
    }
    if (endless.fluid && endless.fluid->openfoam) {
        OpenFoam& openfoam = *endless.fluid->openfoam;
        openfoam.functions.reset();
        openfoam.write.reset();
        if (!openfoam.schemes && !openfoam.solution) endless.fluid->openfoam.reset();
    }
    if (endless.control) endless.control->timeout_s = Control{}.timeout_s;
    for_each_named_file(endless, [](std::string& file) { file = content_of(file); });
    return scene_hash(endless);
}

}  // namespace magfsi::scene
