#include "structure/equilibrium/stability.h"

#include <cmath>

#include "structure/equilibrium/foundation.h"

namespace magfsi::structure {

int negative_eigenvalues(StaticProblem& problem, const Eigen::VectorXd& x) {
    problem.assemble(x, rigid_foundation(problem));
    return problem.matrix().count_negative();
}

Eigen::VectorXd lowest_mode(StaticProblem& problem, const Eigen::VectorXd& x) {
    // In factors of two: the shift exceeds -w by at most as much, and the iteration gains
    // a factor of at least two to the next mode that is not negative.
    double shift = rigid_foundation(problem);
    for (problem.assemble(x, shift); !problem.matrix().factorize();
         problem.assemble(x, shift)) {
        shift = std::max(2 * shift, 1e-3 * problem.bending_stiffness_scale());
    }
    // Any start without symmetry; fixed, so that results repeat.
    Eigen::VectorXd mode(x.size());
    for (Eigen::Index q = 0; q < x.size(); ++q) {
        mode[q] = std::sin(1.0 + 0.7 * static_cast<double>(q % 97));
    }
    for (int iteration = 0; iteration < 20; ++iteration) {
        for (Eigen::Index q = 0; q < x.size(); ++q) {
            mode[q] *= problem.node_volumes_m3()[q / 3];
        }
        mode = problem.solve(mode);
        mode /= mode.cwiseAbs().maxCoeff();
    }
    return mode;
}

}  // namespace magfsi::structure
