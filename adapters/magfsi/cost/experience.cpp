#include "adapters/magfsi/cost/experience.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "adapters/magfsi/cost/calibration.h"
#include "coupler/output/atomic_file.h"

namespace magfsi::launch {

namespace {

using Json = nlohmann::json;

std::filesystem::path file() {
    return calibration_file().parent_path() / "paths.json";
}

Json read() {
    std::ifstream in(file());
    Json json = Json::parse(in, nullptr, false);
    const bool ours = json.is_object() && json.value("machine", "") == machine() &&
                      json.value("version", "") == MAGFSI_VERSION;
    return ours ? json : Json{{"machine", machine()}, {"version", MAGFSI_VERSION}};
}

std::string key(std::uint64_t scene_hash) {
    return fmt::format("{:016x}", scene_hash);
}

}  // namespace

std::map<int, double> experienced_wall_s(std::uint64_t scene_hash) {
    const Json json = read();
    std::map<int, double> seconds;
    const auto found = json.find(key(scene_hash));
    if (found == json.end() || !found->is_object()) return seconds;
    for (const auto& [ranks, wall_s] : found->items()) {
        if (wall_s.is_number()) seconds[std::atoi(ranks.c_str())] = wall_s.get<double>();
    }
    return seconds;
}

void keep_experience(std::uint64_t scene_hash, int ranks, double wall_s) {
    const auto before = experienced_wall_s(scene_hash);
    if (const auto same = before.find(ranks);
        same != before.end() && same->second <= wall_s)
        return;
    Json json = read();
    Json& path = json[key(scene_hash)];
    if (!path.is_object()) path = Json::object();
    path[fmt::format("{}", ranks)] = wall_s;
    std::error_code none;  // told by the write
    std::filesystem::create_directories(file().parent_path(), none);
    try {
        output::write_atomically(file(), json.dump(2) + "\n");
    } catch (const std::exception&) {  // the next prediction knows a little less
    }
}

}  // namespace magfsi::launch
