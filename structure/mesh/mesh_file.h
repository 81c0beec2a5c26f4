// A mesh as text, as the solvers read it: numbers read back exactly. Meshes of other
// programs are turned into it once, so that no solver loads their libraries.
//
//   # magfsi mesh [m]
//   nodes N                 N lines: x y z
//   regions R               R lines: a name (may be 0: one piece without a name)
//   elements M              M lines: n0 ... n7 region; -1 without regions
//   faces F                 F times: "COUNT NAME", then a line of COUNT node numbers
//   points P                the same for named points and lines
#pragma once

#include <filesystem>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Writes all but the centre line; reading takes it from the line named "centre_line",
// where there is one (centre_line.h). Both throw std::runtime_error that names the file;
// reading also the line and what was expected in it.
void write_mesh_file(const Mesh& mesh, const std::filesystem::path& file);
Mesh read_mesh_file(const std::filesystem::path& file);

}  // namespace magfsi::structure
