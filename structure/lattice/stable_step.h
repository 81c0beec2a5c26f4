// Largest stable step of the velocity-Verlet scheme.
#pragma once

#include "structure/body.h"

namespace magfsi::structure {

// Bound [s] from the elements: omega_max^2 <= max over elements of the largest eigenvalue
// of K_e p = omega^2 M_e p, with K_e the tangent stiffness at rest and M_e the element's
// own lumped masses, each of its own material (the body's masses are their sum, also
// where materials meet); step = 2 / omega_max. Large compression stiffens the material:
// run at 0.9 of it. Throws std::invalid_argument on a density that is not positive.
//
// With Kelvin-Voigt damping (viscosity.h), whose forces a velocity-Verlet step takes at
// the velocity of the half step before, the bound is the largest step with step^2 omega^2
// + 2 step c <= 4: step = 2 / omega (sqrt(1 + z^2) - z), z = c / (2 omega), with omega^2
// and c the largest eigenvalues of stiffness and damping over mass.
double stable_step_s(const Body& body);

// As if no material were viscous.
double stable_elastic_step_s(Body body);

}  // namespace magfsi::structure
