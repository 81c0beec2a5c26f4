// SPDX-License-Identifier: GPL-2.0-or-later
// The velocity that the scene gives to a side of the box.
#pragma once

#include <string>
#include <vector>

#include "adapters/openfoam/engine/engine.h"
#include "adapters/scene/scene.h"

namespace magfsi::openfoam {

// By face of this rank's part of a side, the first axis of its plane fastest: velocity
// over its mean, 0 outside the opening. The mean over the opening is 1 whatever the
// profile.
std::vector<double> slab_shape(const scene::Fluid& fluid, const BoxMesh& mesh, int side);

// The velocity over time as a boundary condition of OpenFOAM, by its own expressions.
std::string inlet_condition(const scene::Fluid& fluid, const BoxMesh& mesh, int side);

// 0 to 1, as (1 - cos(pi t / ramp)) / 2.
double inlet_ramp(const fluid::Boundary& inlet, double time_s);

}  // namespace magfsi::openfoam
