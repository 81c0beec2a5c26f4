// Damped Newton's method that goes downhill: finds a minimum of the energy from anywhere.
#pragma once

#include "structure/equilibrium/mixed_iteration.h"

namespace magfsi::structure {

// Each step minimises the quadratic model of the energy with a foundation of its own
// (Levenberg), the weakest of those tried that makes the tangent positive definite, and
// is halved until the energy falls (Armijo) with every J positive. Ends at a minimum, or
// where the start was one already at an equilibrium of any kind.
Correction energy_descent(StaticProblem& problem, const Eigen::VectorXd& start,
                          const Eigen::VectorXd& load, double tolerance,
                          int most_iterations);

}  // namespace magfsi::structure
