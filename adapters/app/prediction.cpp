// SPDX-License-Identifier: GPL-2.0-or-later
// Predicted time and memory: each kind of work times its measured cost (struct
// Calibration). The model is linear except for the size of the lattice and of the mesh,
// in which it interpolates by power laws.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "adapters/app/cost.h"
#include "adapters/run_scene.h"
#include "adapters/scene/scene.h"
#include "base/fitted/constants.h"

namespace magfsi::launch {

// JSON conversions for calibration.json, whose keys are the names of the members.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FluidSpeed, cells, ranks, single_precision,
                                   s_per_cell_step)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(NewtonSpeed, nodes, s_per_point)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(
    Calibration, machine, date, fluid, newton, s_per_cell_regularized, s_per_wall_cell,
    s_per_element_substep, s_per_substep, s_per_substep_exchange, s_per_marker_substep,
    s_per_marker_step, s_per_coupled_step, s_per_coupled_step_shared, s_per_coupled_cell,
    s_per_coupled_cell_shared, s_per_cell_row, s_per_cell_enstrophy, s_per_probe_row,
    s_per_cell_byte, s_per_element_file, fluid_bytes, coupled_fluid_bytes, lammps_bytes,
    newton_bytes, bytes_per_cell, bytes_per_cell_file, bytes_per_cell_curl,
    bytes_per_element, newton_bytes_per_element, bytes_per_marker, structure_file_bytes)

namespace {

// Path $XDG_CACHE_HOME/magfsi/calibration.json, or ~/.cache/magfsi/calibration.json.
std::filesystem::path calibration_file() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    const std::filesystem::path folder =
        cache && *cache ? std::filesystem::path(cache)
                        : std::filesystem::path(home ? home : "/tmp") / ".cache";
    return folder / "magfsi/calibration.json";
}

// Size of an element in a structure field file: 8 corners, and 9 + 4 numbers for the data
// around them, as counted on a strip.
constexpr double bytes_per_element_file = 280;
constexpr double bytes_per_probe_row = 600;

// Interpolates y(x) as a power law through two points; constant beyond them.
double between(double x, double x1, double y1, double x2, double y2) {
    if (x <= x1 || x1 == x2) return y1;
    if (x >= x2) return y2;
    const double part = std::log(x / x1) / std::log(x2 / x1);
    return y1 * std::pow(y2 / y1, part);
}

// Wall time of one update of a cell [s], interpolated over the size of the lattice: small
// lattices fit into caches, large ones are bound by the memory's bandwidth. Any number of
// ranks above one takes the figures of the calibration's largest number.
double cell_step_s(const FluidWork& work, const Calibration& c) {
    const FluidSpeed *below = nullptr, *above = nullptr;
    int max_ranks = 1;
    for (const FluidSpeed& s : c.fluid) max_ranks = std::max(max_ranks, s.ranks);
    const int ranks = std::min(work.ranks, max_ranks);
    for (const FluidSpeed& s : c.fluid) {
        if (s.single_precision != work.single_precision) continue;
        if (s.ranks != (ranks > 1 ? max_ranks : 1)) continue;
        if (!below || s.cells < below->cells) below = &s;
        if (!above || s.cells > above->cells) above = &s;
    }
    if (!below) return 0;
    return between(work.cells, below->cells, below->s_per_cell_step, above->cells,
                   above->s_per_cell_step);
}

// Time of the fluid [s]: steps, probes and files. s_per_cell_step is measured with all
// ranks at work; collisions, walls and probes share the ranks, markers and files do not.
double fluid_s(const Work& work, const Calibration& c) {
    const FluidWork& f = *work.fluid;
    const double markers = work.structure ? work.structure->markers : 0;
    const double a_step =
        f.cells * cell_step_s(f, c) + markers * c.s_per_marker_step +
        ((f.recursive_collision ? f.cells * c.s_per_cell_regularized : 0) +
         f.wall_cells * c.s_per_wall_cell) /
            f.ranks;
    return work.steps * work.iterations * a_step +
           f.sum_rows * f.cells * c.s_per_cell_row / f.ranks +
           f.enstrophy_rows * f.cells * c.s_per_cell_enstrophy / f.ranks +
           f.files * f.cells * f.bytes_per_cell * c.s_per_cell_byte;
}

// Part of a coupled step's time [s] that the work of neither side explains: messages,
// waiting, caches.
double exchange_s(const Work& work, const Calibration& c) {
    const bool shared = work.fluid->ranks + work.structure->ranks > available_cores();
    return shared ? c.s_per_coupled_step_shared +
                        work.fluid->cells * c.s_per_coupled_cell_shared
                  : c.s_per_coupled_step + work.fluid->cells * c.s_per_coupled_cell;
}

// Wall time of a substep [s]. Ranks share elements, markers and dipole pairs evenly, and
// exchange ghost nodes.
double substep_s(const StructureWork& s, const Calibration& c) {
    return c.s_per_substep + (s.ranks > 1 ? c.s_per_substep_exchange : 0) +
           (s.elements * c.s_per_element_substep + s.markers * c.s_per_marker_substep +
            s.dipoles * fitted::s_per_dipole) /
               s.ranks;
}

// Time of the structure [s]: substeps, probes and files.
double structure_s(const Work& work, const Calibration& c) {
    const StructureWork& s = *work.structure;
    return work.steps * work.iterations * s.substeps * substep_s(s, c) +
           s.probe_rows * c.s_per_probe_row + s.files * s.elements * c.s_per_element_file;
}

// Time of a path of equilibria [s]. The cost of a point is a power law of the number of
// nodes through the smallest and the largest mesh measured.
double newton_s(const Work& work, const Calibration& c) {
    const StructureWork& s = *work.structure;
    if (c.newton.size() < 2) return 0;
    const NewtonSpeed &a = c.newton.front(), &b = c.newton.back();
    const double power =
        std::log(b.s_per_point / a.s_per_point) / std::log(b.nodes / a.nodes);
    return work.path->points * a.s_per_point * std::pow(s.nodes / a.nodes, power) +
           s.files * s.elements * c.s_per_element_file;
}

// Memory per cell [bytes] that is needed only while probes or files are written.
double passing_bytes(const FluidWork& f, const Calibration& c) {
    const double curl = f.enstrophy_rows > 0 ? c.bytes_per_cell_curl : 0;
    if (f.files == 0) return curl;
    return std::max(
        curl, c.bytes_per_cell_file + (f.vorticity_files ? c.bytes_per_cell_curl : 0));
}

// Memory and disk space [bytes] of all ranks.
void add_memory(const Work& work, const Calibration& c, Prediction& p) {
    if (work.structure) {
        const StructureWork& s = *work.structure;
        const bool newton = work.path && work.path->newton;
        p.structure_bytes =
            s.ranks * (newton ? c.newton_bytes : c.lammps_bytes) +
            (s.files > 0 ? c.structure_file_bytes : 0) +
            s.elements * (newton ? c.newton_bytes_per_element : c.bytes_per_element) +
            s.markers * c.bytes_per_marker;
        p.disk_bytes += s.files * s.elements * bytes_per_element_file +
                        s.probe_rows * bytes_per_probe_row;
    }
    if (!work.fluid) return;
    const FluidWork& f = *work.fluid;
    p.fluid_bytes = f.ranks * (work.structure ? c.coupled_fluid_bytes : c.fluid_bytes) +
                    f.cells * c.bytes_per_cell * (f.single_precision ? 0.5 : 1) +
                    f.cells * passing_bytes(f, c);
    p.disk_bytes += f.files * f.cells * f.bytes_per_cell;
    if (!work.structure) p.disk_bytes += f.probe_rows * bytes_per_probe_row;
}

// The sides take turns, so that their times add up.
Prediction predict(const Work& work, const Calibration& c) {
    Prediction p;
    add_memory(work, c, p);
    if (work.path) {
        if (work.path->newton) p.wall_s = p.structure_s = newton_s(work, c);
        return p;
    }
    if (work.structure) p.structure_s = structure_s(work, c);
    if (work.fluid) p.fluid_s = fluid_s(work, c);
    if (work.fluid && work.structure)
        p.exchange_s = work.steps * work.iterations * exchange_s(work, c);
    p.wall_s =
        p.structure_s.value_or(0) + p.fluid_s.value_or(0) + p.exchange_s.value_or(0);
    return p;
}

// Returns the same work with another number of ranks.
Work on_ranks(Work work, const Ranks& ranks) {
    if (work.fluid) work.fluid->ranks = ranks.at("fluid");
    if (work.structure) work.structure->ranks = ranks.at("structure");
    return work;
}

// Other numbers of ranks to consider: at most one rank a core; Newton's method runs on
// one rank only.
std::vector<Ranks> other_ranks(const Work& work, const Ranks& ranks) {
    std::vector<Ranks> all;
    if (work.path && work.path->newton) return all;
    const std::string role = work.fluid ? "fluid" : "structure";
    for (int n = 1; n <= available_cores(); ++n) {
        all.push_back(ranks);
        if (work.structure) all.back()["structure"] = 1;
        all.back()[role] = n;
    }
    return all;
}

// Numbers of ranks, at most one a core, on which the run is predicted to be clearly
// faster, and the predicted time [s]; nullopt if there are none. Memory is not
// considered.
std::optional<std::pair<Ranks, double>> faster_ranks(const Work& work, const Ranks& ranks,
                                                     double wall_s,
                                                     const Calibration& calibration) {
    // Smaller gains are within the prediction's error.
    constexpr double clearly = 0.85;
    double min_s = clearly * wall_s;
    std::optional<std::pair<Ranks, double>> best;
    for (const Ranks& other : other_ranks(work, ranks)) {
        const Prediction p = predict(on_ranks(work, other), calibration);
        if (!p.wall_s || *p.wall_s >= min_s) continue;
        min_s = *p.wall_s;
        best = {other, min_s};
    }
    return best;
}

// Two significant digits are all that a prediction is worth.
std::string duration(double seconds) {
    if (seconds < 120) return fmt::format("{:.2g} s", seconds);
    if (seconds < 7200) return fmt::format("{:.2g} min", seconds / 60);
    return fmt::format("{:.2g} h", seconds / 3600);
}

// Predicted time with its parts, or the reason why it is unknown.
std::string time_line(const Prediction& p, bool path) {
    if (!p.wall_s)
        return "unknown: damped motion takes as many steps as it needs to come to rest";
    std::string text = duration(*p.wall_s);
    if (path) {
        text +=
            " if Newton's method meets no instability on the path, several times "
            "that if it does";
    }
    if (p.exchange_s) {
        text += fmt::format(" (structure {}, fluid {}, messages {})",
                            duration(*p.structure_s), duration(*p.fluid_s),
                            duration(*p.exchange_s));
    }
    return text;
}

}  // namespace

// Part of the calibration's key: another processor or number of cores needs another one.
std::string machine() {
    return fmt::format("{}, {} cores", processor(), available_cores());
}

// A file of another format counts as no calibration.
std::optional<Calibration> read_calibration() {
    std::ifstream in(calibration_file());
    const auto json = nlohmann::json::parse(in, nullptr, false);
    try {
        if (!json.is_object() || json.value("version", "") != MAGFSI_VERSION ||
            json.value("machine", "") != machine())
            return std::nullopt;
        return json.get<Calibration>();
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;  // written in another format
    }
}

// OpenFOAM is not calibrated.
std::optional<Prediction> prediction(const scene::Scene& scene,
                                     const bodies::Solids& solids, const Ranks& ranks) {
    if (scene.fluid && !fluid_program(scene).predicted) return std::nullopt;
    const auto calibration = read_calibration();
    if (!calibration) return std::nullopt;
    return predict(work_of(scene, solids, ranks), *calibration);
}

// Memory is given for the participants that there are.
nlohmann::ordered_json to_json(const Prediction& p) {
    nlohmann::ordered_json out;
    out["wall_s"] = p.wall_s ? nlohmann::ordered_json(*p.wall_s) : nullptr;
    if (p.structure_bytes > 0) out["memory_bytes"]["structure"] = p.structure_bytes;
    if (p.fluid_bytes > 0) out["memory_bytes"]["fluid"] = p.fluid_bytes;
    out["disk_bytes"] = p.disk_bytes;
    return out;
}

// Numbers of ranks that are clearly faster are named with the option that takes them.
std::string explain_cost(const scene::Scene& scene, const bodies::Solids& solids,
                         const Ranks& ranks) {
    std::string text = fmt::format("\ncost on ranks {}\n", to_text(ranks));
    if (scene.fluid && !fluid_program(scene).predicted)
        return text + fmt::format("  not predicted with fluid.solver {}\n",
                                  scene::name_of(scene.fluid->solver));
    const auto calibration = read_calibration();
    if (!calibration) {
        return text +
               "  not known: this machine is not calibrated; ./magfsi bench "
               "--calibrate does it in half a minute\n";
    }
    const Work work = work_of(scene, solids, ranks);
    const Prediction p = predict(work, *calibration);
    text +=
        fmt::format("  time    {}\n", time_line(p, scene.time.equilibrium.has_value()));
    const auto faster =
        p.wall_s ? faster_ranks(work, ranks, *p.wall_s, *calibration) : std::nullopt;
    if (faster) {
        text += fmt::format("  faster  with --ranks {}: {}\n", to_text(faster->first),
                            duration(faster->second));
    }
    text +=
        fmt::format("  memory  {:.3g} MB\n", (p.structure_bytes + p.fluid_bytes) / 1e6);
    text += fmt::format("  disk    {:.3g} MB\n", p.disk_bytes / 1e6);
    return text + fmt::format("  as calibrated on {}, {}\n", calibration->machine,
                              calibration->date);
}

}  // namespace magfsi::launch
