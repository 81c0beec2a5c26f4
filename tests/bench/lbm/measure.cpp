#include "tests/bench/lbm/measure.h"

#include <algorithm>
#include <cmath>

#include "fluid_lbm/solver.h"
#include "tests/bench/lbm/copy_bandwidth.h"

namespace magfsi::bench {

namespace {

using namespace fluid;

SolverConfig lattice_config(const Settings& settings, const Variant& variant) {
    SolverConfig config;
    config.cells = settings.cells;
    config.periodic = {true, true, true};
    config.collision.omega = 1 / 0.6;
    config.kernels = run_kernels(choose_kernels().kernels, variant.precision,
                                 variant.collision, false);
    return config;
}

// A slow flow: populations that are no zeros, which some machines move faster.
template <class Real>
void set_flow(const PopulationRows<Real>& rows, const RowLayout& layout) {
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            const double u = 0.01 * std::sin(0.1 * y);
            for (int q = 0; q < d3q19::directions; ++q) {
                std::fill_n(rows.row(q, layout.row(y, z)), layout.nx,
                            static_cast<Real>(3 * d3q19::weight(q) * d3q19::c[q][0] * u));
            }
        }
    }
}

// Forces in a square column of rows, as around a body.
void set_forces(Solver& solver, double share) {
    if (share <= 0) return;
    const RowLayout& layout = solver.layout();
    const std::vector<double> force(3 * static_cast<std::size_t>(layout.nx), 1e-9);
    const double side = std::sqrt(share);
    for (int z = 0; z < std::lround(side * layout.nz); ++z) {
        for (int y = 0; y < std::lround(side * layout.ny); ++y) {
            solver.forces().add(y, z, 0, force, 1);
        }
    }
}

// Seconds of `steps` steps, that of the slowest rank; forces are set outside the time.
double step_seconds(MPI_Comm comm, Solver& solver, double share, int steps) {
    double elapsed = 0;
    for (int i = 0; i < steps; ++i) {
        set_forces(solver, share);
        MPI_Barrier(comm);
        const double start = MPI_Wtime();
        solver.step();
        elapsed += MPI_Wtime() - start;
    }
    MPI_Allreduce(MPI_IN_PLACE, &elapsed, 1, MPI_DOUBLE, MPI_MAX, comm);
    return elapsed;
}

// Seconds of one halo exchange with nothing between its parts.
double exchange_seconds(MPI_Comm comm, const Solver& solver, double seconds) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    Halo halo(comm, solver.decomposition(), rank, solver.populations());
    int exchanges = 0, enough = 0;
    MPI_Barrier(comm);
    const double start = MPI_Wtime();
    while (enough == 0) {
        for (const Exchange exchange : {Exchange::fill, Exchange::give_back}) {
            halo.start(exchange);
            halo.finish();
            ++exchanges;
        }
        enough = MPI_Wtime() - start > seconds ? 1 : 0;
        MPI_Bcast(&enough, 1, MPI_INT, 0, comm);
    }
    return (MPI_Wtime() - start) / exchanges;
}

}  // namespace

Spread spread(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return {values[values.size() / 2], values.front(), values.back()};
}

Result measure(MPI_Comm comm, const Settings& settings, const Variant& variant) {
    Solver solver(comm, lattice_config(settings, variant));
    solver.populations().visit(
        [&](const auto& rows) { set_flow(rows, solver.layout()); });
    InPlaceCopy copy(comm, solver.populations().bytes());
    const double cells =
        static_cast<double>(settings.cells[0]) * settings.cells[1] * settings.cells[2];
    const double bytes_a_cell = 2.0 * d3q19::directions *
                                static_cast<double>(solver.populations().element_bytes());

    const double two = step_seconds(comm, solver, variant.forced_share, 2);
    const int steps = 2 * std::max(1, static_cast<int>(settings.seconds / two));
    std::vector<double> mlups, copies, shares, exchanges;
    copy.bytes_per_second(0);
    for (int i = 0; i < settings.repetitions; ++i) {
        const double before = copy.bytes_per_second(settings.seconds / 2);
        const double step =
            step_seconds(comm, solver, variant.forced_share, steps) / steps;
        const double rate = cells / step;
        const double after = copy.bytes_per_second(settings.seconds / 2);
        const double limit = (before + after) / 2;
        mlups.push_back(1e-6 * rate);
        copies.push_back(1e-9 * limit);
        shares.push_back(rate * bytes_a_cell / limit);
        exchanges.push_back(exchange_seconds(comm, solver, settings.seconds / 10) / step);
    }
    return {variant, spread(mlups), spread(copies), spread(shares), spread(exchanges)};
}

}  // namespace magfsi::bench
