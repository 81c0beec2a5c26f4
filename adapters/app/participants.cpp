// SPDX-License-Identifier: GPL-2.0-or-later
// The table of fluid solvers, and the number of ranks that each participant gets.
#include "adapters/app/participants.h"

#include "adapters/app/mpirun.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "adapters/run_scene.h"
#include "adapters/scene/scene.h"
#include "adapters/solvers/lbm/explain.h"
#include "adapters/solvers/lbm/scene_to_fluid.h"
#include "adapters/solvers/openfoam/explain.h"

namespace magfsi::launch {

namespace {

// Entries in the order of the enumeration scene::FluidSolver.
const std::array fluid_programs = std::to_array<FluidProgram>({
    {"magfsi-fluid-lbm", [] { return std::string(); }, &lbm::explain,
     [](const scene::Scene&) { return std::numeric_limits<int>::max(); }, true},
    {"magfsi-fluid-openfoam", &openfoam::missing, &openfoam::explain,
     &openfoam::most_ranks, false},
});
static_assert(std::tuple_size_v<decltype(fluid_programs)> ==
              scene::names<scene::FluidSolver>.size());

// The structure gets one rank unless --ranks gives it more. Both sides take turns, so
// that the fluid may use every core.
int default_ranks(const scene::Scene& scene, const std::string& role) {
    if (role == "structure") return 1;
    return std::min({worthwhile_parts(*scene.fluid), available_cores(),
                     fluid_program(scene).most_ranks(scene)});
}

// Refuses far more ranks than cores: they take turns on the cores, and a large job hardly
// advances.
void check_number(const Ranks& ranks) {
    constexpr int ranks_a_core = 4, always_allowed = 8;
    const int most = std::max(always_allowed, ranks_a_core * available_cores());
    int all = 0;
    for (const auto& [role, number] : ranks) all += number;
    if (all <= most || has_more_machines()) return;
    throw std::invalid_argument(fmt::format(
        "--ranks: found {} ranks in all; allowed are {} on this machine, {} for each of "
        "its {} cores",
        all, most, ranks_a_core, available_cores()));
}

// Refuses more structure ranks than elements, for a rank without elements would idle.
void check_structure(const scene::Scene& scene, const bodies::Solids& solids, int ranks) {
    if (ranks == 1 || solids.empty()) return;
    if (by_newton(scene))
        throw std::invalid_argument(fmt::format(
            "--ranks structure={}: allowed is 1; equilibria are solved by one process",
            ranks));
    std::size_t elements = 0;
    for (const structure::Body& solid : solids) elements += solid.mesh.elements.size();
    if (static_cast<std::size_t>(ranks) <= elements) return;
    throw std::invalid_argument(fmt::format(
        "--ranks structure={}: the bodies have {} elements in all; allowed is "
        "a rank for each element at most",
        ranks, elements));
}

}  // namespace

const FluidProgram& fluid_program(const scene::Scene& scene) {
    return fluid_programs.at(static_cast<int>(scene.fluid->solver));
}

bool by_newton(const scene::Scene& scene) {
    return scene.time.equilibrium &&
           scene.time.equilibrium->method == scene::EquilibriumMethod::newton;
}

// Bodies are moved by LAMMPS, or brought to equilibrium by Newton's method in a program
// of its own.
std::map<std::string, std::string> programs_of(const scene::Scene& scene) {
    std::map<std::string, std::string> programs;
    if (scene.has_own_structure())
        programs["structure"] = "";  // run --structure names it
    if (!scene.bodies.empty())
        programs["structure"] =
            by_newton(scene) ? "magfsi-equilibrium" : "magfsi-structure";
    if (scene.fluid) programs["fluid"] = fluid_program(scene).program;
    return programs;
}

// Numbers of more than five digits are refused, too, so that stoi cannot overflow.
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
    // The map is sorted by name; people name the structure first.
    for (const char* role : {"structure", "fluid"}) {
        if (!ranks.contains(role)) continue;
        text += fmt::format("{}{}={}", text.empty() ? "" : ",", role, ranks.at(role));
    }
    return text;
}

// Defaults first, then the given numbers, then the limits.
Ranks choose_ranks(const scene::Scene& scene, const bodies::Solids& solids,
                   const Ranks& given) {
    Ranks ranks;
    for (const auto& [role, name] : programs_of(scene))
        ranks[role] = default_ranks(scene, role);
    for (const auto& [role, number] : given) {
        if (!ranks.contains(role)) {
            throw std::invalid_argument(
                fmt::format("--ranks {}={}: the scene has no {}", role, number, role));
        }
        ranks[role] = number;
    }
    check_number(ranks);
    if (scene.fluid && ranks.at("fluid") > fluid_program(scene).most_ranks(scene)) {
        throw std::invalid_argument(
            fmt::format("--ranks fluid={}: allowed is {} for this scene's fluid.solver; "
                        "OpenFOAM's mesh around obstacles is not cut into parts",
                        ranks.at("fluid"), fluid_program(scene).most_ranks(scene)));
    }
    if (ranks.contains("structure"))
        check_structure(scene, solids, ranks.at("structure"));
    return ranks;
}

// Lower bound of the fluid's memory: 19 populations a cell (D3Q19). Batch systems may
// distribute it over machines and are not checked.
void check_memory(const scene::Scene& scene, const bodies::Solids& solids) {
    if (!scene.fluid || has_more_machines()) return;
    const bool single = scene.fluid->solver == scene::FluidSolver::lbm &&
                        scene.fluid->precision != fluid::Precision::double_;
    const double bytes_a_cell = 19 * (single ? 4 : 8);  // populations; openfoam has more
    const double there = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                         static_cast<double>(sysconf(_SC_PAGESIZE));
    double cells = 1;
    for (const double length : scene.fluid->box_m)
        cells *= length / scene.fluid->spacing_m;
    if (scene.fluid->refinement) {
        cells = 0;
        for (const auto& level : lbm::level_configs(scene, solids))
            cells += lbm::cells_of(level);
    }
    if (cells * bytes_a_cell <= there) return;
    throw std::invalid_argument(fmt::format(
        "fluid.spacing: found {:.3g} cells, which take {:.3g} GB; allowed are {:.3g} in "
        "this machine's {:.3g} GB of memory",
        cells, cells * bytes_a_cell / 1e9, there / bytes_a_cell, there / 1e9));
}

}  // namespace magfsi::launch
