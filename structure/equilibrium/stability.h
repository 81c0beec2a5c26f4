// Whether an equilibrium is a minimum of the energy.
#pragma once

#include "structure/equilibrium/static_problem.h"

namespace magfsi::structure {

// Negative eigenvalues of the tangent at x on the foundation of foundation.h.
int negative_eigenvalues(StaticProblem& problem, const Eigen::VectorXd& x);

// The mode K m = w V m of lowest w, V the volumes of the nodes; largest component 1.
// Found by inverse iteration with the tangent made positive definite by a shift.
Eigen::VectorXd lowest_mode(StaticProblem& problem, const Eigen::VectorXd& x);

}  // namespace magfsi::structure
