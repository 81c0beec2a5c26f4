// The LAMMPS data file (atom_style sphere) of all nodes.
#pragma once

#include <filesystem>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

struct DataAtom {
    Vec3 position_m{};
    double mass_kg = 0;
};

// Atom IDs count from 1 in the given order; one atom type; at rest. Diameters are zero,
// for which LAMMPS takes the density column as the mass. The box is that of the atoms and
// a little more. Throws std::runtime_error if the file cannot be written.
void write_data_file(const std::vector<DataAtom>& atoms,
                     const std::filesystem::path& file);

}  // namespace magfsi::structure
