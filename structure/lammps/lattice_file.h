// SPDX-License-Identifier: GPL-2.0-or-later
// The files that a script names: the lattice file of fix magttice, one body's mesh and
// magnetisation as text,
//
//   # comment lines
//   nodes N
//   x y z                          N lines [m]
//   elements M
//   n0 ... n7  Mx My Mz  MATERIAL  M lines; node numbers from 0, magnetisation [A/m]; the
//                                  number of the material may be left out: 0
//
// and the LAMMPS data file (atom_style sphere) of the nodes of all bodies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

struct LatticeFile {
    std::vector<Vec3> nodes_m;
    std::vector<Hexahedron> elements;
    std::vector<Vec3> magnetization_a_m;  // one per element
    std::vector<int> element_material;    // one per element; empty: all 0
};

// Numbers are written so that they read back exactly. Empty magnetisation is written as
// zeros, an empty element_material not at all. Read, it is empty where all are 0. Both
// throw std::runtime_error that names the file (and what was expected in it).
void write_lattice_file(const LatticeFile& lattice, const std::filesystem::path& file);
LatticeFile read_lattice_file(const std::filesystem::path& file);

struct DataAtom {
    Vec3 position_m{};
    double mass_kg = 0;
};

// Atom IDs count from 1 in the given order; one atom type; at rest. Diameters are zero,
// for which LAMMPS takes the density column as the mass. The box is that of the atoms and
// a little more. Throws std::runtime_error if the file cannot be written.
void write_data_file(const std::vector<DataAtom>& atoms,
                     const std::filesystem::path& file);

// The variant of `fix magttice ... element WORD`. Throws std::invalid_argument on another
// word.
ElementVariant parse_element_name(const std::string& word);

}  // namespace magfsi::structure
