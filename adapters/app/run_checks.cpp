// SPDX-License-Identifier: GPL-2.0-or-later
// Each check throws with the option's name first, what was found, and what is allowed, in
// the form of a scene's faults.
#include "adapters/app/run_checks.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace magfsi::launch {

namespace fs = std::filesystem;

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

}  // namespace magfsi::launch
