// SPDX-License-Identifier: GPL-2.0-or-later
// Lines of `explain` on a material: stiffening and viscoelasticity.
#pragma once

#include <string>

#include "structure/options.h"

namespace magfsi::launch {

// The text tells how far a bar can be stretched and how stiff it is on the way, and the
// storage and the loss modulus against frequency; it is empty for a neo-Hookean material
// without branches. The viscosity counts in the loss modulus.
std::string explain_material(const structure::Material& material);

}  // namespace magfsi::launch
