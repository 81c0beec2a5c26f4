// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/bench/lbm/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "fluid_lbm/parallel/halo.h"
#include "fluid_lbm/streaming/kernel_choice.h"

namespace magfsi::bench {

namespace {

using namespace fluid;

// A slow flow: populations that are no zeros, which some machines move faster.
FluidConfig lattice_config(const Settings& settings, const Variant& variant) {
    FluidConfig config;
    config.cells = settings.cells;
    config.spacing_m = config.time_step_s = config.density_kg_m3 = 1;
    config.viscosity_m2_s = 0.1 / 3;
    config.collision = variant.collision;
    config.precision = variant.precision;
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.01 * std::sin(0.1 * x[1]), 0, 0};
    };
    return config;
}

// Forces in a square column of rows, as around a body.
void set_forces(Fluid& fluid, double share) {
    if (share <= 0) return;
    const CellBox box = fluid.owned();
    const double side = std::sqrt(share);
    std::vector<CellRow> rows;
    for (int z = 0; z < std::lround(side * (box.hi[2] - box.lo[2])); ++z) {
        for (int y = 0; y < std::lround(side * (box.hi[1] - box.lo[1])); ++y)
            rows.push_back({box.lo[1] + y, box.lo[2] + z, 0, box.hi[0]});
    }
    fluid.set_force(rows, std::vector<double>(3 * rows.size() * box.hi[0], 1e-9));
}

// Seconds of `steps` steps, that of the slowest rank; forces are set outside the time.
double step_seconds(MPI_Comm comm, Fluid& fluid, double share, int steps) {
    double elapsed = 0;
    for (int i = 0; i < steps; ++i) {
        set_forces(fluid, share);
        MPI_Barrier(comm);
        const double start = MPI_Wtime();
        fluid.step();
        elapsed += MPI_Wtime() - start;
    }
    MPI_Allreduce(MPI_IN_PLACE, &elapsed, 1, MPI_DOUBLE, MPI_MAX, comm);
    return elapsed;
}

// Seconds of one halo exchange with nothing between its parts.
double exchange_seconds(MPI_Comm comm, const Decomposition& parts, int rank,
                        const Populations& populations, double seconds) {
    Halo halo(comm, parts, rank, populations);
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
    Fluid fluid(comm, lattice_config(settings, variant));
    int rank = 0, ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &ranks);
    const Decomposition parts = decompose(settings.cells, {true, true, true}, ranks);
    const RowLayout layout = parts.layout(rank);
    // For the exchange alone, as large as the fluid's own.
    const Populations populations(layout.nx, layout.row_count(), variant.precision);
    InPlaceCopy copy(comm, populations.bytes());
    const double cells =
        static_cast<double>(settings.cells[0]) * settings.cells[1] * settings.cells[2];
    const double bytes_a_cell =
        2.0 * d3q19::directions * static_cast<double>(populations.element_bytes());

    const double two = step_seconds(comm, fluid, variant.forced_share, 2);
    const int steps = 2 * std::max(1, static_cast<int>(settings.seconds / two));
    std::vector<double> mlups, copies, shares, exchanges;
    copy.bytes_per_second(0);
    for (int i = 0; i < settings.repetitions; ++i) {
        const double before = copy.bytes_per_second(settings.seconds / 2);
        const double step =
            step_seconds(comm, fluid, variant.forced_share, steps) / steps;
        const double rate = cells / step;
        const double after = copy.bytes_per_second(settings.seconds / 2);
        const double limit = (before + after) / 2;
        mlups.push_back(1e-6 * rate);
        copies.push_back(1e-9 * limit);
        shares.push_back(rate * bytes_a_cell / limit);
        exchanges.push_back(
            exchange_seconds(comm, parts, rank, populations, settings.seconds / 10) /
            step);
    }
    return {variant, spread(mlups), spread(copies), spread(shares), spread(exchanges)};
}

double peer_mlups(const std::string& program, const Settings& settings,
                  const std::string& kind, int ranks) {
    // Without the variables by which a program under mpirun finds its own job, or the
    // peer's mpirun would join it.
    constexpr const char* clean_environment =
        "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMPI_ALLOW_RUN_AS_ROOT=1 "
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
        "OMPI_MCA_hwloc_base_binding_policy=none OMP_NUM_THREADS=1 ";
    const std::string command = fmt::format(
        "{} mpirun -n {} '{}' {} {} {} {} {}", clean_environment, ranks, program, kind,
        settings.cells[0], settings.cells[1], settings.cells[2], settings.seconds);
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
    std::string last;
    std::array<char, 256> line{};
    while (std::fgets(line.data(), line.size(), pipe) != nullptr) last = line.data();
    const int status = pclose(pipe);
    char* end = nullptr;
    const double mlups = std::strtod(last.c_str(), &end);
    if (status != 0 || end == last.c_str()) {
        throw std::runtime_error("peer program failed: " + command);
    }
    return mlups;
}

}  // namespace magfsi::bench
