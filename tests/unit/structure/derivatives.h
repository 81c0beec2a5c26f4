// SPDX-License-Identifier: GPL-2.0-or-later
// Forces as differences of the energy, tangents as differences of the forces.
#pragma once

#include <gtest/gtest.h>

#include "structure/equilibrium/static_problem.h"

namespace magfsi::structure::test {

// Of the problem as it was last assembled, all loads in it.
inline Eigen::MatrixXd whole_tangent(StaticProblem& problem) {
    Eigen::MatrixXd tangent = problem.matrix().lower_triangle();
    tangent = tangent.selfadjointView<Eigen::Lower>();
    return tangent;
}

// Central differences at x, in every coordinate that is not held. column_n_m: of the
// tangent's columns; share: of forces, in the largest.
inline void expect_derivatives(StaticProblem& problem, const Body& body,
                               const Eigen::VectorXd& x, const NodalLoads& loads,
                               const Eigen::MatrixXd& tangent, double column_n_m,
                               double share) {
    const auto held = held_axes(body);
    const Eigen::VectorXd forces = problem.response(x, loads).residual_n;
    const double step_m = 1e-9;
    for (Eigen::Index q = 0; q < x.size(); ++q) {
        if (held[static_cast<std::size_t>(q / 3)][static_cast<std::size_t>(q % 3)])
            continue;
        Eigen::VectorXd ahead = x, back = x;
        ahead[q] += step_m;
        back[q] -= step_m;
        const auto to = problem.response(ahead, loads),
                   from = problem.response(back, loads);
        const Eigen::VectorXd column = (from.residual_n - to.residual_n) / (2 * step_m);
        EXPECT_LT((column - tangent.col(q)).cwiseAbs().maxCoeff(), column_n_m)
            << "coordinate " << q;
        EXPECT_NEAR((from.total_j - to.total_j) / (2 * step_m), forces[q],
                    share * forces.cwiseAbs().maxCoeff())
            << "coordinate " << q;
    }
}

}  // namespace magfsi::structure::test
