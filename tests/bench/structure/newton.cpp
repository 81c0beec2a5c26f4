// SPDX-License-Identifier: GPL-2.0-or-later
// What a Newton step costs beside CHOLMOD's own time in it: a clamped plate bends in a
// field across its magnetisation. Processor time, since others may use the machine.
//   magfsi-bench-newton [ALONG ACROSS LAYERS [MILLITESLA]]      60 60 2 16.5 unless given
#include <cholmod.h>
#include <dlfcn.h>
#include <sys/resource.h>

#include <array>
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

double peak_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

// Time in CHOLMOD, and how often; what the calls below add up.
struct InCholmod {
    double factorization_s = 0, solution_s = 0;
    int factorizations = 0, failed = 0, solutions = 0;
} in_cholmod;

template <class Function>
Function* of_cholmod(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// These stand before CHOLMOD's own when the program is linked.
extern "C" int cholmod_factorize_p(cholmod_sparse* matrix, double shift[2], int* rows,
                                   size_t count, cholmod_factor* factor,
                                   cholmod_common* common) {
    static const auto own = of_cholmod<decltype(cholmod_factorize_p)>(__func__);
    const double start_s = processor_s();
    const int done = own(matrix, shift, rows, count, factor, common);
    in_cholmod.factorization_s += processor_s() - start_s;
    ++in_cholmod.factorizations;
    in_cholmod.failed += common->status == CHOLMOD_NOT_POSDEF;
    return done;
}
extern "C" cholmod_dense* cholmod_solve(int system, cholmod_factor* factor,
                                        cholmod_dense* right_side,
                                        cholmod_common* common) {
    static const auto own = of_cholmod<decltype(cholmod_solve)>(__func__);
    const double start_s = processor_s();
    cholmod_dense* solution = own(system, factor, right_side, common);
    in_cholmod.solution_s += processor_s() - start_s;
    ++in_cholmod.solutions;
    return solution;
}

int main(int argc, char** argv) {
    std::array<int, 3> n{60, 60, 2};
    for (int d = 0; d < std::min(argc - 1, 3); ++d) n[d] = std::atoi(argv[d + 1]);
    Body body;
    body.name = "plate";
    body.mesh = box_mesh({{30e-3, 30e-3, 1e-3}, n});
    body.material = {330e3, 6600e3, 1860};
    body.element = ElementVariant::assumed_strain;
    body.clamps = {"x_min"};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {100e3, 0, 0});
    const double field_mt = argc > 4 ? std::atof(argv[4]) : 16.5;
    const StaticLoads loads{{0, 0, 1e-3 * field_mt}, {}};

    const double start_s = processor_s();
    NewtonSolver solver(body);
    const double setup_s = processor_s() - start_s;
    const Equilibrium found = solver.solve(loads);
    const double solve_s = processor_s() - start_s - setup_s;
    // One more than steps: for the number of negative eigenvalues.
    const int tangents = found.iterations + 1;
    const InCholmod& in = in_cholmod;
    const double cholmod_s = in.factorization_s + in.solution_s;
    const double once_s =
        in.factorization_s / in.factorizations + in.solution_s / in.solutions;
    std::printf(
        "%d x %d x %d: %zu elements, %zu unknowns, set up in %.3g s, memory %.0f MB\n"
        "%d steps of %.3g s; %d factorisations, of which %d found no positive definite "
        "matrix\n"
        "CHOLMOD: %.3g s a step; %.3g s once factorised and solved\n"
        "a step takes %.2f of CHOLMOD's time in it, %.2f of once factorised and solved\n",
        n[0], n[1], n[2], body.mesh.elements.size(), 3 * body.mesh.nodes.size(), setup_s,
        peak_mb(), found.iterations, solve_s / tangents, in.factorizations, in.failed,
        cholmod_s / tangents, once_s, solve_s / cholmod_s, solve_s / tangents / once_s);
}
