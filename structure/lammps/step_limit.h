// The stable step of a body with springs on its surface.
#pragma once

#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

// How much surface a node stands for [m2]: length of its share of the vector area of the
// boundary, at rest. That is the tributary area on flat parts, that of the mean direction
// at edges and corners (a plain sum would make the edges of a sheet stiffer than its
// middle). Zero for inner nodes.
std::vector<double> surface_areas(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements);

// Largest step [s] with step^2 (omega^2 + w) + 2 step c <= 4, omega and c the body's own
// largest frequency and damping (stable_step_s), w the largest stiffness * area / mass of
// a surface node: a bound, since the largest eigenvalue of a sum is at most the sum of
// the largest. Run at 0.9 of it. Throws as stable_step_s.
double step_limit_s(const Body& body, double stiffness_pa_m);

}  // namespace magfsi::structure
