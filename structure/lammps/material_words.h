// SPDX-License-Identifier: GPL-2.0-or-later
// Words of fix magttice on a material beyond its moduli and viscosity. They follow the
// words of the material that they belong to.
#pragma once

#include <span>
#include <string>

#include "structure/options.h"

namespace magfsi::structure {

// " stiffening LAW NUMBERS branch G TIME ...", empty for a neo-Hookean material.
std::string material_words(const Material& material);

// Reads the words after "stiffening", of which further keywords may follow; returns how
// many belong to it. Throws std::invalid_argument on an unknown law or missing numbers.
int read_stiffening(std::span<char*> words, Material& material);

}  // namespace magfsi::structure
