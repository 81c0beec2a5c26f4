// Newton's method with the volume of each element as an unknown of its own.
#pragma once

#include "structure/equilibrium/static_problem.h"

namespace magfsi::structure {

struct Correction {
    Eigen::VectorXd x;
    StaticProblem::Response response;  // at x
    double residual = 0;               // relative_residual at x
    int iterations = 0;
    bool converged = false;
    double first_step_m = 0;  // mixed_iteration: linear answer to the load step
    double foundation = 0;    // energy_descent: the last that made the tangent positive
};

// The stationary point of  springs(x) + sum V0 U(theta) + p (V(x) - V0 theta) - f.x  in
// x, theta and p; theta and p are eliminated element by element, so that a step costs
// what a Newton step of x alone costs:
//   [G L + p d2V + U''(theta)/V0 dV dV^T] dx = f - G L x - dV [U' + U'' (V/V0 - theta)].
// A step that turns elements changes V at second order only; taken from x alone, U'(J)
// then jumps by K times the angle squared and spoils the next tangent, which bounds the
// load steps of slender bodies. Here p follows the linearised volume. (The idea is that
// of Magisano, Leonetti, Garcea, Int. J. Numer. Methods Eng. 109 (2017) 1237.)
//
// Local: gives up, without an equilibrium, when a node has moved from the start by more
// than largest_move_m, when an element has lost its way, or after most_iterations. J may
// be negative on the way, but not in what is called converged.
Correction mixed_iteration(StaticProblem& problem, const Eigen::VectorXd& start,
                           const Eigen::VectorXd& load, double tolerance,
                           int most_iterations, double largest_move_m);

}  // namespace magfsi::structure
