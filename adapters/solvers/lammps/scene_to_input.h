// SPDX-License-Identifier: GPL-2.0-or-later
// Conversion of the scene to the input of structure/lammps.
#pragma once

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

// The bodies with their loads, supports and surroundings. In a fluid the bodies' masses
// lack those of the enclosed fluid (bodies_in_fluid). The time step is left to the
// caller. Throws std::invalid_argument on an effect that this build lacks, and on contact
// with obstacles of a shape that it does not know.
structure::LammpsInput to_lammps_input(const scene::Scene& scene,
                                       const bodies::Solids& solids);

// Largest stable LAMMPS step over all bodies, with the stiffness of platform and contact
// and with viscosity [s]. Infinite if no node can move.
double stable_step_s(const structure::LammpsInput& input);

}  // namespace magfsi::lammps
