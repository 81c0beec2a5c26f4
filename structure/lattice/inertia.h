// SPDX-License-Identifier: GPL-2.0-or-later
// Masses of the nodes. An element's mass spread evenly on its nodes (by the integrals of
// its shape functions) has moments of inertia that are too large: by 2 / n^2 along an
// axis of n elements.
#pragma once

#include "structure/body.h"

namespace magfsi::structure {

// Masses of each element's nodes [kg]. With Inertia::corrected a share of the mass on the
// surface moves to the opposite nodes of the element. A share of 1/12 of the element's
// thickness, the next term of the Euler-Maclaurin formula, gives quadratic velocities
// their kinetic energy; on few elements a slightly larger one gives the body its moments
// of inertia. Along an axis of a single element no correction is possible.
std::vector<std::array<double, 8>> element_masses_kg(const Body& body);

// Relative errors of the moments of inertia about the axes x, y, z through the centre of
// mass of the soft elements: those of the nodes over those of the continuum, less 1. The
// body must have a soft element.
Vec3 inertia_error(const Body& body);

}  // namespace magfsi::structure
