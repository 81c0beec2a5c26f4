// The lattice file that fix magttice reads: one body's mesh and magnetisation as text.
//
//   # comment lines
//   nodes N
//   x y z                          N lines [m]
//   elements M
//   n0 ... n7  Mx My Mz  MATERIAL  M lines; node numbers from 0, magnetisation [A/m]; the
//                                  number of the material may be left out: 0
#pragma once

#include <filesystem>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

struct LatticeFile {
    std::vector<Vec3> nodes_m;
    std::vector<Hexahedron> elements;
    std::vector<Vec3> magnetization_a_m;  // one an element
    std::vector<int> element_material;    // one an element; empty: all 0
};

// Numbers are written so that they read back exactly. Empty magnetisation is written as
// zeros, an empty element_material not at all. Read, it is empty where all are 0. Both
// throw std::runtime_error that names the file (and what was expected in it).
void write_lattice_file(const LatticeFile& lattice, const std::filesystem::path& file);
LatticeFile read_lattice_file(const std::filesystem::path& file);

}  // namespace magfsi::structure
