#include "fluid_lbm/sampling/totals.h"

#include <algorithm>
#include <cmath>

#include "fluid_lbm/sampling/velocity_field.h"

namespace magfsi::fluid {

namespace {

// Summed over ranks: excess of density, momentum, energy.
enum { excess, momentum, energy = momentum + 3, cell_count, sums };

struct Local {
    double sum[sums] = {};
    double max_speed_squared = 0;
};

void add_row(const RowMoments& m, Local& local) {
    for (std::size_t x = 0; x < m.excess.size(); ++x) {
        const double density = 1 + m.excess[x];
        double u_squared = 0;
        for (int a = 0; a < 3; ++a) {
            const double u = m.j[a][x] / density;
            u_squared += u * u;
            local.sum[momentum + a] += m.j[a][x];
        }
        local.sum[excess] += m.excess[x];
        local.sum[energy] += 0.5 * density * u_squared;
        local.max_speed_squared = std::max(local.max_speed_squared, u_squared);
    }
}

double fluid_cells_in_row(const Solver& solver, int y, int z) {
    const int nx = solver.layout().nx;
    if (!solver.obstacles()) return nx;
    int count = 0;
    for (int x = 0; x < nx; ++x) count += solver.is_solid({x, y, z}) ? 0 : 1;
    return count;
}

}  // namespace

double mean_enstrophy(MPI_Comm comm, const Solver& solver,
                      const std::array<Vec3, 6>& lattice_wall_velocity) {
    const RowLayout& layout = solver.layout();
    const VelocityField field = sample_velocity(comm, solver);
    double local[2] = {};  // sum, cells
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            if (!solver.obstacles()) {
                local[0] += field.enstrophy_of_row(y, z, lattice_wall_velocity);
                local[1] += layout.nx;
                continue;
            }
            for (int x = 0; x < layout.nx; ++x) {
                if (solver.is_solid({x, y, z})) continue;
                local[0] += field.enstrophy(x, y, z, lattice_wall_velocity);
                local[1] += 1;
            }
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, local, 2, MPI_DOUBLE, MPI_SUM, comm);
    return local[0] / local[1];
}

Totals totals(MPI_Comm comm, const Solver& solver, const Units& unit) {
    const RowLayout& layout = solver.layout();
    RowMoments m;
    Local local;
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            row_moments(solver.view(), y, z, 0, layout.nx, m);
            add_row(m, local);
            local.sum[cell_count] += fluid_cells_in_row(solver, y, z);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, local.sum, sums, MPI_DOUBLE, MPI_SUM, comm);
    MPI_Allreduce(MPI_IN_PLACE, &local.max_speed_squared, 1, MPI_DOUBLE, MPI_MAX, comm);

    const double cells = local.sum[cell_count];  // solid ones hold rest: no excess
    const double mass = unit.cell_mass_kg(), speed = unit.velocity_m_s();
    Totals total;
    total.mass_kg = mass * (cells + local.sum[excess]);
    for (int a = 0; a < 3; ++a) {
        total.momentum_kg_m_s[a] = mass * speed * local.sum[momentum + a];
    }
    total.kinetic_energy_j = mass * speed * speed * local.sum[energy];
    total.max_speed_m_s = speed * std::sqrt(local.max_speed_squared);
    return total;
}

}  // namespace magfsi::fluid
