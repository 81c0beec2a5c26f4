// SPDX-License-Identifier: GPL-2.0-or-later
// Where a body starts: its relaxed shape, turned and moved.
#pragma once

#include <array>
#include <vector>

#include "structure/body.h"
#include "structure/lammps/field_program.h"

namespace magfsi::structure {

// Node positions after relaxing, rotating and moving, in this order. The centre of volume
// is taken with the nodes' volumes at rest, as masses are. Throws as NewtonSolver
// does.
std::vector<Vec3> placed_nodes(const Body& body, const Placement& placement,
                               const std::array<int, 2>& field_plane);

}  // namespace magfsi::structure
