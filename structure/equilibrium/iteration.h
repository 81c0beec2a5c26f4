// SPDX-License-Identifier: GPL-2.0-or-later
// The two Newton iterations at constant load: a mixed one, which converges in few steps
// near an equilibrium, and an energy descent, which finds a minimum from any start.
#pragma once

#include "structure/equilibrium/static_problem.h"

namespace magfsi::structure {

// Result of an iteration. Both kinds end when the residual reaches the goal.
struct Iterate {
    // Positions of the nodes [m], x y z of each in turn
    Eigen::VectorXd x;
    StaticProblem::Response response;  // at x
    int iterations = 0;
    bool converged = false;
    // mixed_iteration: the tangent at the start was positive definite
    bool stable_start = true;
    // mixed_iteration: largest component of the first step, the linear response to the
    // load
    double first_step_m = 0;
};

// Newton's method for the stationary point of  springs(x) + sum V0 U(theta) + p (V(x) -
// V0 theta) - f.x  in x, theta and p. The volume ratio theta and the pressure p are
// eliminated element by element, so that a step costs as much as a Newton step of x
// alone:
//   [G L + p d2V + U''(theta)/V0 dV dV^T] dx = f - G L x - dV [U' + U'' (V/V0 - theta)].
// A step that turns elements changes V at second order only. In Newton's method for x
// alone U'(J) then jumps by K times the angle squared and spoils the next tangent, which
// limits the load steps of slender bodies; here p follows the linearised volume. (The
// idea is that of Magisano, Leonetti, Garcea, Int. J. Numer. Methods Eng. 109 (2017)
// 1237.)
//
// drive_m: displacement of the driven nodes from the start [m]. The first step moves
// them, and the body with them by its linear response. Empty: they stay.
//
// The method is local. It stops without convergence when a node has moved from the start
// by more than largest_move_m, when the volume of an element is far out of range, or
// after max_iterations. J may be negative on the way, but not in a converged result.
Iterate mixed_iteration(StaticProblem& problem, const Eigen::VectorXd& start,
                        const NodalLoads& load, const Goal& goal, int max_iterations,
                        double largest_move_m, Eigen::VectorXd drive_m = {});

// Damped Newton's method. Each step minimises the quadratic model of the energy plus a
// foundation, springs to the present place (Levenberg), the weakest of those tried that
// makes the tangent positive definite. The step is halved until the energy falls enough
// (Armijo) with every J positive. The result is a minimum, or an equilibrium of any kind
// if the start was already one.
Iterate energy_descent(StaticProblem& problem, const Eigen::VectorXd& start,
                       const NodalLoads& load, const Goal& goal, int max_iterations);

// A Newton step [m] at x without the translation and rotation that no support prevents.
Eigen::VectorXd deformation(const StaticProblem& problem, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& step);

}  // namespace magfsi::structure
