// SPDX-License-Identifier: GPL-2.0-or-later
// `magfsi lattice`: converts the bodies of a scene to files for plain LAMMPS scripts, and
// a lattice file back to a mesh that a scene can read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace magfsi::launch {

// Options of the command line.
struct LatticeOptions {
    // A scene file, a folder with scene.yaml, or a NAME.lattice file.
    std::filesystem::path input;
    std::filesystem::path out = ".";
    std::vector<std::string> overrides;  // --set, allowed with a scene only
};

// Converts the input. A scene becomes bodies.data, one NAME.lattice per body, and
// lammps.in, the script with all loads of the scene. NAME.lattice becomes NAME.msh (Gmsh
// 2.2) and NAME.csv (magnetisation [A/m] at element centres), which a scene can read.
// Returns the exit code. Throws std::invalid_argument and scene::SceneError.
int lattice(const LatticeOptions& options);

}  // namespace magfsi::launch
