#include "structure/equilibrium/energy_descent.h"

#include <algorithm>
#include <cmath>

#include "structure/equilibrium/foundation.h"
#include "structure/equilibrium/motion.h"

namespace magfsi::structure {
namespace {

double energy(const StaticProblem::Response& response, const Eigen::VectorXd& x,
              const Eigen::VectorXd& load) {
    return response.elastic_j - load.dot(x);
}

// The weakest foundation, in factors of ten, under which the tangent is positive
// definite; the matrix is left factorised.
double factorize_shifted(StaticProblem& problem, const Eigen::VectorXd& x, double last) {
    const double least = rigid_foundation(problem);
    const double first = 1e-2 * problem.bending_stiffness_scale();
    double foundation = last > first ? last : least;
    for (int attempt = 0; attempt < 30; ++attempt) {
        problem.assemble(x, foundation);
        if (problem.matrix().factorize()) return foundation;
        foundation = std::max(10 * foundation, first);
    }
    return INFINITY;
}

// Halves the step until the energy falls enough; zero if it never does.
double line_search(const StaticProblem& problem, const Motion& motion,
                   const Correction& now, const Eigen::VectorXd& load, double slope) {
    const double before = energy(now.response, now.x, load);
    // Rounding of the energy: springs and volume terms of about G V cancel at rest.
    const double rounding =
        1e-14 * problem.largest_shear_modulus_pa() * problem.volume_m3();
    double fraction = motion.largest_fraction();
    for (int halving = 0; halving < 40; ++halving, fraction *= 0.5) {
        const Eigen::VectorXd x = motion.at(fraction);
        const auto response = problem.response(x, load);
        if (!(response.smallest_j > 0)) continue;
        if (energy(response, x, load) <= before - 1e-4 * fraction * slope + rounding) {
            return fraction;
        }
    }
    return 0;
}

}  // namespace

Correction energy_descent(StaticProblem& problem, const Eigen::VectorXd& start,
                          const Eigen::VectorXd& load, double tolerance,
                          int most_iterations) {
    Correction out;
    out.x = start;
    for (;; ++out.iterations) {
        out.response = problem.response(out.x, load);
        if (!(out.response.smallest_j > 0)) return out;
        out.residual = problem.relative_residual(out.response, load);
        out.converged = out.residual < tolerance;
        if (out.converged || out.iterations == most_iterations) return out;
        out.foundation = factorize_shifted(problem, out.x, 0.1 * out.foundation);
        if (!std::isfinite(out.foundation)) return out;
        const Eigen::VectorXd step = problem.solve(out.response.residual_n);
        const Motion motion(problem, out.x, step);
        const double fraction =
            line_search(problem, motion, out, load, out.response.residual_n.dot(step));
        if (!(fraction > 0)) return out;
        out.x = motion.at(fraction);
    }
}

}  // namespace magfsi::structure
