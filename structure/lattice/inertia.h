// SPDX-License-Identifier: GPL-2.0-or-later
// Masses of the nodes. An element spread evenly on its nodes (the integrals of its shape
// functions) has too large moments of inertia: by 2 / n^2 along an axis of n elements.
#pragma once

#include "structure/body.h"

namespace magfsi::structure {

// Of each element, on its nodes [kg]. With Inertia::corrected a share of the mass on the
// surface goes to the element's nodes opposite: with 1/12 of an element's thickness, the
// next term of Euler's and Maclaurin's sum, quadratic velocities have their energy; with
// a little more on few elements the body has its moments of inertia. Nothing can be done
// along an axis of a single element.
std::vector<std::array<double, 8>> element_masses_kg(const Body& body);

// Moments of inertia about the axes through the centre of mass, relative to those of the
// continuum, less 1.
Vec3 inertia_error(const Body& body);

}  // namespace magfsi::structure
