#include "adapters/magfsi/cost/experience.h"

#include <fmt/format.h>

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

std::optional<double> experienced_wall_s(std::uint64_t scene_hash) {
    const Json json = read();
    const auto found = json.find(key(scene_hash));
    if (found == json.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

void keep_experience(std::uint64_t scene_hash, double wall_s) {
    Json json = read();
    json[key(scene_hash)] = wall_s;
    std::error_code none;  // told by the write
    std::filesystem::create_directories(file().parent_path(), none);
    try {
        output::write_atomically(file(), json.dump(2) + "\n");
    } catch (const std::exception&) {  // the next prediction knows a little less
    }
}

}  // namespace magfsi::launch
