// SPDX-License-Identifier: GPL-2.0-or-later
// Velocity profiles and ramps of inlets at the sides of the box.
#pragma once

#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/openfoam/engine/engine.h"

namespace magfsi::openfoam {

// Velocity over its mean in each face of this rank's part of a side, the first axis of
// the side's plane fastest; 0 outside the opening. For any profile the mean over the
// opening is 1.
std::vector<double> slab_shape(const scene::Fluid& fluid, const BoxMesh& mesh, int side);

// The same at any points of a side.
std::vector<double> shape_at_faces(const scene::Fluid& fluid, const BoxMesh& mesh,
                                   int side,
                                   const std::vector<std::array<double, 3>>& centres_m);

// The inlet's velocity as an OpenFOAM boundary condition with expressions of place and
// time, for stock programs.
std::string inlet_condition(const scene::Fluid& fluid, const BoxMesh& mesh, int side);

// Factor of the velocity during the ramp, (1 - cos(pi t / ramp)) / 2, from 0 to 1.
double inlet_ramp(const fluid::Boundary& inlet, double time_s);

}  // namespace magfsi::openfoam
