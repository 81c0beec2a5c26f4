// SPDX-License-Identifier: GPL-2.0-or-later
// Start of a body: its relaxed shape, rotated and moved.
#pragma once

#include <array>
#include <vector>

#include "structure/body.h"
#include "structure/lammps/field_program.h"

namespace magfsi::structure {

// Positions of the nodes [m] after relaxing, rotating and moving, in this order. The
// centre of volume is the mean over the nodes, weighted by their volumes in the
// undeformed body, as for the centre of mass. field_plane: plane of the angle in
// Placement::relaxed. Throws as NewtonSolver does.
std::vector<Vec3> placed_nodes(const Body& body, const Placement& placement,
                               const std::array<int, 2>& field_plane);

}  // namespace magfsi::structure
