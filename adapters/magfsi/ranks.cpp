#include "adapters/magfsi/ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "adapters/magfsi/mpi_job.h"

namespace magfsi::launch {

namespace {

int default_ranks(const scene::Scene& scene, const std::string& role) {
    if (role == "structure") return 1;
    // Where structure and fluid take turns the fluid may have every core, where both work
    // at once all but the structure's, as long as each rank has enough cells to be worth
    // its messages.
    const bool at_once =
        scene.coupling && scene.coupling->scheme == coupler::Scheme::parallel;
    const int cores = std::max(1, available_cores() - (at_once ? 1 : 0));
    constexpr double fewest_cells_a_rank = 20000;
    double cells = 1;
    for (const double length : scene.fluid->box_m)
        cells *= length / scene.fluid->spacing_m;
    return std::clamp(static_cast<int>(cells / fewest_cells_a_rank), 1, cores);
}

}  // namespace

Ranks parse_ranks(const std::string& text) {
    Ranks ranks;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, ',');) {
        const auto equals = part.find('=');
        const std::string role = part.substr(0, equals);
        const std::string number =
            equals == std::string::npos ? "" : part.substr(equals + 1);
        const bool digits = !number.empty() && number.size() < 6 &&
                            number.find_first_not_of("0123456789") == std::string::npos;
        if ((role != "structure" && role != "fluid") || !digits ||
            std::stoi(number) < 1) {
            throw std::invalid_argument(
                fmt::format("--ranks: found '{}'; allowed is structure=N,fluid=M with N "
                            "and M of 1 or more",
                            part));
        }
        ranks[role] = std::stoi(number);
    }
    return ranks;
}

std::string to_text(const Ranks& ranks) {
    std::string text;
    // Of the map, the structure comes last; people name it first.
    for (const char* role : {"structure", "fluid"}) {
        if (!ranks.contains(role)) continue;
        text += fmt::format("{}{}={}", text.empty() ? "" : ",", role, ranks.at(role));
    }
    return text;
}

Ranks choose_ranks(const scene::Scene& scene, const Ranks& given) {
    Ranks ranks;
    if (!scene.bodies.empty()) ranks["structure"] = default_ranks(scene, "structure");
    if (scene.fluid) ranks["fluid"] = default_ranks(scene, "fluid");
    for (const auto& [role, number] : given) {
        if (!ranks.contains(role)) {
            throw std::invalid_argument(
                fmt::format("--ranks {}={}: the scene has no {}", role, number, role));
        }
        ranks[role] = number;
    }
    return ranks;
}

}  // namespace magfsi::launch
