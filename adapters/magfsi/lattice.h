// SPDX-License-Identifier: GPL-2.0-or-later
// `magfsi lattice`: the bodies of a scene as files for plain LAMMPS scripts, and back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace magfsi::launch {

struct LatticeOptions {
    std::filesystem::path input;  // a scene, its folder, or a lattice file
    std::filesystem::path out = ".";
    std::vector<std::string> overrides;  // of the scene
};

// Of a scene: bodies.data, a NAME.lattice a body and lammps.in, the script with all of
// its loads. Of NAME.lattice: NAME.msh for Gmsh and NAME.csv with the magnetisation,
// which a scene reads. The exit code; throws std::invalid_argument and scene::SceneError.
int lattice(const LatticeOptions& options);

}  // namespace magfsi::launch
