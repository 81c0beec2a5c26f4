// SPDX-License-Identifier: GPL-2.0-or-later
// The two Newton iterations at a constant load: a mixed one that converges in few steps
// from near an equilibrium, and a descent of the energy that finds one from anywhere.
#pragma once

#include "structure/equilibrium/static_problem.h"

namespace magfsi::structure {

// Both end where the residual reaches the goal.
struct Iterate {
    Eigen::VectorXd x;
    StaticProblem::Response response;  // at x
    int iterations = 0;
    bool converged = false;
    bool stable_start = true;  // mixed_iteration: the tangent at the start
    double first_step_m = 0;   // mixed_iteration: linear response to the load step
};

// The stationary point of  springs(x) + sum V0 U(theta) + p (V(x) - V0 theta) - f.x  in
// x, theta and p; theta and p are eliminated element by element, so that a step costs
// what a Newton step of x alone costs:
//   [G L + p d2V + U''(theta)/V0 dV dV^T] dx = f - G L x - dV [U' + U'' (V/V0 - theta)].
// A step that turns elements changes V at second order only; taken from x alone, U'(J)
// then jumps by K times the angle squared and spoils the next tangent, which limits the
// load steps of slender bodies. Here p follows the linearised volume. (The idea is that
// of Magisano, Leonetti, Garcea, Int. J. Numer. Methods Eng. 109 (2017) 1237.)
//
// drive_m: by how much the driven nodes move on from the start; the first step takes them
// along, the body with them as far as it is linear. Empty: they stay.
//
// Local: stops without convergence when a node has moved from the start by more than
// largest_move_m, when the volume of an element is far out of range, or after
// max_iterations. J may be negative on the way, but not where it has converged.
Iterate mixed_iteration(StaticProblem& problem, const Eigen::VectorXd& start,
                        const NodalLoads& load, const Goal& goal, int max_iterations,
                        double largest_move_m, Eigen::VectorXd drive_m = {});

// Damped Newton's method. Each step minimises the quadratic model of the energy on a
// foundation of its own (Levenberg), the weakest of those tried that makes the tangent
// positive definite, and is halved until the energy falls (Armijo) with every J positive.
// Ends at a minimum or, where the start was one already, at an equilibrium of any kind.
Iterate energy_descent(StaticProblem& problem, const Eigen::VectorXd& start,
                       const NodalLoads& load, const Goal& goal, int max_iterations);

// The step at x without the rigid motion that nothing holds.
Eigen::VectorXd deformation(const StaticProblem& problem, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& step);

}  // namespace magfsi::structure
