// SPDX-License-Identifier: GPL-2.0-or-later
// Files that a script names: the lattice file of fix magttice, which holds one body's
// mesh and magnetisation as text,
//
//   # comment lines
//   nodes N
//   x y z                          N lines [m]
//   elements M
//   n0 ... n7  Mx My Mz  MATERIAL RIGID
//                                  M lines; node numbers from 0, magnetisation [A/m]; the
//                                  number of the material is 0 if it is left out, that
//                                  of the rigid part -1, for a soft element
//
// and the LAMMPS data file (atom_style sphere) with the nodes of all bodies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

// Contents of a lattice file.
struct LatticeFile {
    std::vector<Vec3> nodes_m;
    std::vector<Hexahedron> elements;
    std::vector<Vec3> magnetization_a_m;  // one vector per element
    std::vector<int> element_material;    // one number per element; empty: all 0
    std::vector<int> element_rigid{};     // one number per element; empty: all -1
};

// Write and read a lattice file. Numbers have 17 digits and are exact when read back.
// Empty magnetisation is written as zeros, an empty element_material not at all unless
// element_rigid has numbers; when read, element_material is empty if all numbers are 0,
// element_rigid if all are -1. Both throw std::runtime_error with the file, and with what
// was expected in it.
void write_lattice_file(const LatticeFile& lattice, const std::filesystem::path& file);
LatticeFile read_lattice_file(const std::filesystem::path& file);

// A node as LAMMPS gets it.
struct DataAtom {
    Vec3 position_m{};
    double mass_kg = 0;
};

// Writes a data file for read_data: atom IDs count from 1 in the given order, one atom
// type, no velocities. Diameters are zero, for which LAMMPS takes the density column as
// the mass. The box holds all atoms with a margin of 1 % of its longest edge. Throws
// std::runtime_error if the file cannot be written.
void write_data_file(const std::vector<DataAtom>& atoms,
                     const std::filesystem::path& file);

// Element variant of the word in `fix magttice ... element WORD`. Throws
// std::invalid_argument on any other word.
ElementVariant parse_element_name(const std::string& word);

}  // namespace magfsi::structure
