#include "adapters/magfsi/cost/calibration.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "adapters/magfsi/mpi_job.h"

namespace magfsi::launch {

namespace {

using Json = nlohmann::json;

struct Entry {
    const char* key;
    double Calibration::*value;
};

constexpr Entry entries[] = {
    {"s_per_cell_regularized", &Calibration::s_per_cell_regularized},
    {"s_per_wall_cell", &Calibration::s_per_wall_cell},
    {"s_per_element_substep", &Calibration::s_per_element_substep},
    {"s_per_substep", &Calibration::s_per_substep},
    {"s_per_substep_exchange", &Calibration::s_per_substep_exchange},
    {"s_per_marker_substep", &Calibration::s_per_marker_substep},
    {"s_per_marker_step", &Calibration::s_per_marker_step},
    {"s_per_coupled_step", &Calibration::s_per_coupled_step},
    {"s_per_coupled_step_shared", &Calibration::s_per_coupled_step_shared},
    {"s_per_coupled_cell", &Calibration::s_per_coupled_cell},
    {"s_per_coupled_cell_shared", &Calibration::s_per_coupled_cell_shared},
    {"s_per_cell_row", &Calibration::s_per_cell_row},
    {"s_per_cell_enstrophy", &Calibration::s_per_cell_enstrophy},
    {"s_per_probe_row", &Calibration::s_per_probe_row},
    {"s_per_cell_byte", &Calibration::s_per_cell_byte},
    {"s_per_element_file", &Calibration::s_per_element_file},
    {"fluid_bytes", &Calibration::fluid_bytes},
    {"coupled_fluid_bytes", &Calibration::coupled_fluid_bytes},
    {"lammps_bytes", &Calibration::lammps_bytes},
    {"newton_bytes", &Calibration::newton_bytes},
    {"bytes_per_cell", &Calibration::bytes_per_cell},
    {"bytes_per_cell_file", &Calibration::bytes_per_cell_file},
    {"bytes_per_cell_curl", &Calibration::bytes_per_cell_curl},
    {"bytes_per_element", &Calibration::bytes_per_element},
    {"newton_bytes_per_element", &Calibration::newton_bytes_per_element},
    {"bytes_per_marker", &Calibration::bytes_per_marker},
    {"structure_file_bytes", &Calibration::structure_file_bytes},
};

Calibration from_json(const Json& json) {
    Calibration c;
    c.machine = json.at("machine");
    c.date = json.at("date");
    for (const Json& speed : json.at("fluid")) {
        c.fluid.push_back({speed.at("cells"), speed.at("ranks"),
                           speed.at("single_precision"), speed.at("s_per_cell_step")});
    }
    for (const Json& speed : json.at("newton"))
        c.newton.push_back({speed.at("nodes"), speed.at("s_per_point")});
    for (const Entry& entry : entries) c.*entry.value = json.at(entry.key);
    return c;
}

}  // namespace

std::string machine() {
    std::string name = "a processor";
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);) {
        const auto colon = line.find(": ");
        if (!line.starts_with("model name") || colon == std::string::npos) continue;
        name = line.substr(colon + 2);
        break;
    }
    return fmt::format("{}, {} cores", name, available_cores());
}

std::filesystem::path calibration_file() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    const std::filesystem::path folder =
        cache && *cache ? std::filesystem::path(cache)
                        : std::filesystem::path(home ? home : "/tmp") / ".cache";
    return folder / "magfsi/calibration.json";
}

std::optional<Calibration> read_calibration() {
    std::ifstream in(calibration_file());
    const Json json = Json::parse(in, nullptr, false);
    if (!json.is_object() || json.value("version", "") != MAGFSI_VERSION ||
        json.value("machine", "") != machine())
        return std::nullopt;
    try {
        return from_json(json);
    } catch (const Json::exception&) {
        return std::nullopt;  // of another making: as good as none
    }
}

}  // namespace magfsi::launch
