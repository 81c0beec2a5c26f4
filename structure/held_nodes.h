// Which degrees of freedom of a body its clamps and rollers hold.
#pragma once

#include <array>
#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

using HeldAxes = std::array<bool, 3>;

// One entry a node. Throws std::invalid_argument on a face that the mesh lacks.
std::vector<HeldAxes> held_axes(const Body& body);

}  // namespace magfsi::structure
