// SPDX-License-Identifier: GPL-2.0-or-later
// Motion and masses of the nodes of all bodies at one time.
#pragma once

#include <array>
#include <vector>

#include "base/vector/vec3.h"
#include "structure/lammps/rigid_states.h"

namespace magfsi::bodies {

using magfsi::Vec3;

// One entry for each node, in the order of the bodies in the scene and of the nodes in
// each body's mesh. Empty on ranks other than the root where ranks have gathered it.
struct NodalState {
    std::vector<Vec3> position_m, velocity_m_s;
    // In a fluid either the nodes' own masses, less the enclosed fluid, or the whole ones
    // (fluid_inside.h): the function that returns the state says which.
    std::vector<double> mass_kg;
    // Motion of the rigid parts of all bodies, in the order of the bodies and of their
    // parts.
    std::vector<structure::RigidPartMotion> rigid;
};

}  // namespace magfsi::bodies
