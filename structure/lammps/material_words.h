// SPDX-License-Identifier: GPL-2.0-or-later
// Words of fix magttice on a material: its moduli and viscosity, and what follows them.
#pragma once

#include <span>
#include <string>

#include "structure/options.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace magfsi::structure {

// Material of the values G and K and, if there are three, the viscosity.
Material read_material(std::span<char*> words, LAMMPS_NS::LAMMPS* lammps);

// " stiffening LAW NUMBERS branch G TIME ...", empty for a neo-Hookean material.
std::string material_words(const Material& material);

// Reads the words after "stiffening", of which further keywords may follow; returns how
// many belong to it. Throws std::invalid_argument on an unknown law or missing numbers.
int read_stiffening(std::span<char*> words, Material& material);

}  // namespace magfsi::structure
