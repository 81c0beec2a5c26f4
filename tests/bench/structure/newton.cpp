// SPDX-License-Identifier: GPL-2.0-or-later
// What a Newton step costs beside CHOLMOD's own time for its matrix: a clamped plate
// bends in a field across its magnetisation.
//   magfsi-bench-newton [ALONG ACROSS LAYERS]      elements; 60 60 2 unless given
#include <omp.h>
#include <sys/resource.h>

#include <Eigen/CholmodSupport>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "structure/equilibrium/newton.h"
#include "structure/magnetics/magnetization.h"
#include "structure/mesh/block_mesh.h"

namespace {

using namespace magfsi::structure;

double processor_s() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Analysis, factorisation and solution as CHOLMOD alone does them.
double cholmod_s(StaticProblem& problem, const Eigen::VectorXd& right_side) {
    Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor;
    const double start_s = processor_s();
    factor.compute(problem.matrix().lower_triangle());
    const Eigen::VectorXd x = factor.solve(right_side);
    return processor_s() - start_s + 0 * x[0];
}

}  // namespace

int main(int argc, char** argv) {
    std::array<int, 3> n{60, 60, 2};
    for (int d = 0; d < std::min(argc - 1, 3); ++d) n[d] = std::atoi(argv[d + 1]);
    omp_set_max_active_levels(0);  // as StiffnessMatrix does
    Body body;
    body.name = "plate";
    body.mesh = box_mesh({{30e-3, 30e-3, 1e-3}, n});
    body.material = {330e3, 6600e3, 1860};
    body.element = ElementVariant::assumed_strain;
    body.clamps = {"x_min"};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {100e3, 0, 0});
    const StaticLoads loads{{0, 0, 16.5e-3}, {}};

    double at_s = processor_s();
    const auto lap_s = [&] {
        const double before_s = at_s;
        return (at_s = processor_s()) - before_s;
    };
    NewtonSolver solver(body);
    const double setup_s = lap_s();
    const Equilibrium found = solver.solve(loads);
    const double solve_s = lap_s();
    // One factorisation more than steps: that of the number of negative eigenvalues.
    const double step_s = solve_s / (found.iterations + 1);

    StaticProblem problem(body);
    const Eigen::VectorXd x = flat_positions(found.nodes_m);
    lap_s();
    problem.assemble(x);
    const double assembly_s = lap_s();
    problem.matrix().factorize();
    const double factorization_s = lap_s();
    problem.matrix().solve(problem.load(loads).dead_n);
    const double solution_s = lap_s();
    const double alone_s = cholmod_s(problem, problem.load(loads).dead_n);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf(
        "%d x %d x %d elements, %ld unknowns: set up %.3g s, %d steps of %.3g s\n"
        "a step: assembly %.3g, factorisation %.3g, solution %.3g s\n"
        "CHOLMOD alone with analysis %.3g s: a step takes %.2f of it\n"
        "memory %.0f MB\n",
        n[0], n[1], n[2], static_cast<long>(x.size()), setup_s, found.iterations, step_s,
        assembly_s, factorization_s, solution_s, alone_s, step_s / alone_s,
        static_cast<double>(usage.ru_maxrss) / 1024);
}
