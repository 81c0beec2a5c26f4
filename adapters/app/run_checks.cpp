// SPDX-License-Identifier: GPL-2.0-or-later
// Each check throws with the option's name first, what was found, and what is allowed, in
// the form of a scene's faults.
#include "adapters/app/run_checks.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "adapters/solvers/bodies/overlaps.h"
#include "structure/lammps/placement.h"

namespace magfsi::launch {

namespace fs = std::filesystem;

namespace {

// Returns what is wrong in the text of a controller's script; "" if nothing is, or if the
// package magfsi is not there. The shell takes the name in quotes, of which those within
// it are taken out.
std::string fault_in(const std::string& script) {
    std::string quoted;
    for (const char c : script) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    const std::string command =
        fmt::format("{} -P -m magfsi.controller '{}' 2>/dev/null", python, quoted);
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"),
                                                     &pclose);
    std::string text;
    char line[256];
    while (pipe && std::fgets(line, sizeof line, pipe.get())) text += line;
    return text;
}

}  // namespace

// Imports are tried in a new interpreter. -P keeps the current folder, whose files may be
// a stranger's, off Python's path.
void need_controller() {
    const auto imports = [](const std::string& package) {
        const std::string command =
            fmt::format("{} -P -c 'import {}' 2>/dev/null", python, package);
        return std::system(command.c_str()) == 0;
    };
    if (!imports("mpi4py"))
        throw std::invalid_argument(
            "control: needs the Python package mpi4py (Debian: apt install "
            "python3-mpi4py)");
    if (!imports("magfsi.controller"))
        throw std::invalid_argument(
            "control: needs the launcher ./magfsi, which knows the Python package");
}

// Only the command line may name the program: a scene from a stranger must not start one.
void check_structure_program(const scene::Scene& scene, const RunOptions& options) {
    const fs::path& program = options.structure;
    if (scene.has_own_structure() == program.empty()) {
        throw std::invalid_argument(
            program.empty() ? "--structure: missing; the scene's structure is a program "
                              "of your own, which only the command line may name"
                            : "--structure: found beside bodies of the scene; allowed "
                              "with coupling.structure: own");
    }
    std::error_code none;
    if (!program.empty() &&
        (!fs::is_regular_file(program, none) || access(program.c_str(), X_OK) != 0)) {
        throw std::invalid_argument(
            fmt::format("--structure: found '{}'; allowed is a file that can be executed",
                        program.string()));
    }
}

// The folder `runs` and the run folder in it are both checked.
void check_default_out(const scene::Scene& scene, const fs::path& out) {
    std::error_code none;  // false where one of them is not there
    if (!fs::equivalent(scene.folder / ".", ".", none)) return;
    for (const fs::path& path : {out.parent_path(), out}) {
        if (fs::is_symlink(fs::symlink_status(path, none)))
            throw std::invalid_argument(
                fmt::format("{} beside the scene is a link to {}; if it is yours, name "
                            "the run folder with --out",
                            path.string(), fs::read_symlink(path).string()));
    }
}

void check_controller(const scene::Control& control) {
    const std::string fault = fault_in(control.script);
    if (!fault.empty()) throw std::invalid_argument("control.script: found " + fault);
}

void check_overlap_at_start(const scene::Scene& scene, const bodies::Solids& solids) {
    const bool is_found_by_run = std::ranges::any_of(
        scene.bodies,
        [](const scene::Body& body) { return body.initial.relaxed.has_value(); });
    if (!scene.coupling || scene.coupling->overlap == coupler::OverlapRule::allow ||
        is_found_by_run)
        return;
    std::vector<structure::Vec3> start_m;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        const auto nodes =
            structure::placed_nodes(solids[b], scene.bodies[b].initial, {0, 2});
        start_m.insert(start_m.end(), nodes.begin(), nodes.end());
    }
    const auto found = bodies::Overlaps(scene, solids, start_m).find(start_m);
    if (!found.overlap.empty())
        throw std::invalid_argument("bodies overlap at the start: " + found.overlap);
}

}  // namespace magfsi::launch
