// The weak foundation that removes the rigid motions of a free body from the tangent.
#pragma once

#include "structure/equilibrium/static_problem.h"

namespace magfsi::structure {

// Stiffness [Pa/m2] on the diagonal, times the volume of each node; zero for a clamped
// body. It is about 1e-5 of the stiffness of the lowest bending mode and 1e4 or more
// times the rounding of the tangent. Forces have no such term: an equilibrium does not
// feel it. Rigid translations and the turn about the field's axis, which cost no energy,
// get this stiffness; an instability that grows more slowly is not seen.
inline double rigid_foundation(const StaticProblem& problem) {
    return problem.free() ? 1e-3 * problem.bending_stiffness_scale() : 0.0;
}

}  // namespace magfsi::structure
