// Largest stable step of the velocity-Verlet scheme.
#pragma once

#include "structure/body.h"

namespace magfsi::structure {

// Bound [s] from the elements: omega_max^2 <= max over elements of the largest eigenvalue
// of K_e p = omega^2 M_e p, with K_e the tangent stiffness at rest and M_e the element's
// own lumped masses (the body's masses are their sum); step = 2 / omega_max. Large
// compression stiffens the material: run at 0.9 of it. Throws std::invalid_argument on a
// density that is not positive.
double stable_step_s(const Body& body);

}  // namespace magfsi::structure
