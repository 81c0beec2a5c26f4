// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/app/run_again.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "adapters/app/run_checks.h"
#include "adapters/run_scene.h"
#include "adapters/scene/reader.h"
#include "coupler/participants/guard.h"

namespace magfsi::launch {

namespace fs = std::filesystem;

namespace {

bool is_run_folder(const fs::path& path) {
    return fs::is_directory(path) && fs::exists(path / "run.json");
}

}  // namespace

Ranks ranks_of_run(const scene::Scene& scene, const fs::path& path) {
    Ranks ranks;
    if (!is_run_folder(path)) return ranks;
    std::ifstream in(path / "run.json");
    const auto starts = nlohmann::json::parse(in, nullptr, false);
    if (!starts.is_array() || starts.empty() || !starts.back().is_object()) return ranks;
    const auto found = starts.back().find("ranks");
    if (found == starts.back().end() || !found->is_object()) return ranks;
    for (const auto& [role, name] : programs_of(scene)) {
        const auto number = found->find(role);
        if (number != found->end() && number->is_number_integer())
            ranks[role] = number->get<int>();
    }
    if (!ranks.empty())
        fmt::print("on the ranks of {}: {}\n", path.string(), to_text(ranks));
    return ranks;
}

fs::path run_folder(const scene::Scene& scene, const RunOptions& options) {
    const fs::path file = scene::scene_file(options.scene);
    if (!options.out.empty()) {
        refuse_own_scene(file, options.out, options.restart);
        return options.out;
    }
    if (is_run_folder(options.scene) && goes_on_in(options.scene, options.restart))
        return options.scene;
    fs::path out = coupler::default_out(scene.name);
    check_default_out(scene, out);
    std::error_code none;
    if (!fs::equivalent(file, out / "scene.yaml", none)) return out;
    out += "-again";
    check_default_out(scene, out);
    return out;
}

}  // namespace magfsi::launch
