// SPDX-License-Identifier: GPL-2.0-or-later
// Sums over the fluid of all ranks, and fields of the owned cells.
#include <algorithm>
#include <cmath>

#include "fluid_lbm/refuse.h"
#include "fluid_lbm/state.h"

namespace magfsi::fluid {

void moments_in_time(const Fluid::State& s, const CellRow& row, RowMoments& m) {
    row_moments(s.view(), row.y, row.z, row.x_begin, row.x_end, m);
    if (!s.config.body_force_n_m3) return;
    const Vec3 half = half_body_force(s.config);
    for (int x = 0; x < row.size(); ++x) {
        if (s.is_solid({row.x_begin + x, row.y, row.z})) continue;
        for (int a = 0; a < 3; ++a) m.j[a][x] += half[a];
    }
}

namespace {

// Sums over cells in lattice units; `cells` is the number of fluid cells.
struct Sums {
    double excess = 0, momentum[3] = {}, energy = 0, sound = 0, cells = 0;
};

// Adds a row's cells to the sums.
void add_row(const RowMoments& m, Sums& sum, double& max_speed_squared) {
    for (std::size_t x = 0; x < m.excess.size(); ++x) {
        const double density = 1 + m.excess[x];
        double u_squared = 0;
        for (int a = 0; a < 3; ++a) {
            const double u = m.j[a][x] / density;
            u_squared += u * u;
            sum.momentum[a] += m.j[a][x];
        }
        sum.excess += m.excess[x];
        sum.energy += 0.5 * density * u_squared;
        sum.sound += m.excess[x] * m.excess[x] / 6;  // c_s^2 is 1/3
        max_speed_squared = std::max(max_speed_squared, u_squared);
    }
}

void sum_over_ranks(MPI_Comm comm, double* values, int count, MPI_Op op = MPI_SUM) {
    MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, op, comm);
}

// The two layers of cells whose centres lie on either side of a plane, with weights for
// linear interpolation. Within half a cell of an end of the box it is the last layer
// alone, or across a periodic side the layers at both ends.
struct Layers {
    int axis, low, high;  // global indices of the lower and the upper
    double upper;         // weight of the upper
    double weight(int index) const {
        return (index == low ? 1 - upper : 0) + (index == high ? upper : 0);
    }
};

// The layers beside a plane; at_cells: its coordinate in cells, count: cells along the
// axis.
Layers layers_at(int axis, double at_cells, int count, bool periodic) {
    if (periodic) {
        const double low = std::floor(at_cells - 0.5);
        const int index = (static_cast<int>(low) + count) % count;
        return {axis, index, (index + 1) % count, at_cells - 0.5 - low};
    }
    const double centred = std::clamp(at_cells - 0.5, 0.0, count - 1.0);
    const int low = std::min(static_cast<int>(centred), std::max(0, count - 2));
    return {axis, low, low + 1, centred - low};
}

// Sums over the cells of two layers, each cell by the weight of its layer; lattice units.
// The flow is that of mass over the density at rest: it is the same through every plane,
// while that of volume changes with the pressure, as the fluid is slightly compressible.
struct PlaneSums {
    double flow = 0, momentum[3] = {}, excess = 0, cells = 0;
};

void add_cell(const RowMoments& m, std::size_t i, int axis, double weight,
              PlaneSums& sum) {
    const double velocity = m.j[axis][i] / (1 + m.excess[i]);
    sum.flow += weight * m.j[axis][i];
    for (int a = 0; a < 3; ++a) sum.momentum[a] += weight * velocity * m.j[a][i];
    sum.excess += weight * m.excess[i];
    sum.cells += weight;
}

// Sums of this rank over the fluid cells of the layers.
PlaneSums sum_layers(const Fluid::State& s, const Layers& layers) {
    const bool across_rows = layers.axis == 0;
    const bool around = layers.high < layers.low;  // the ends of a periodic box
    const int begin = across_rows && !around ? layers.low : 0;
    const int end =
        across_rows && !around ? std::min(layers.high + 1, s.layout.nx) : s.layout.nx;
    PlaneSums sum;
    RowMoments m;
    for (int z = 0; z < s.layout.nz; ++z) {
        for (int y = 0; y < s.layout.ny; ++y) {
            const double of_row = layers.weight(layers.axis == 1 ? s.owned().lo[1] + y
                                                                 : s.owned().lo[2] + z);
            if (!across_rows && of_row == 0) continue;
            moments_in_time(s, {y, z, begin, end}, m);
            for (int x = begin; x < end; ++x) {
                if (s.is_solid({x, y, z})) continue;
                add_cell(m, static_cast<std::size_t>(x - begin), layers.axis,
                         across_rows ? layers.weight(x) : of_row, sum);
            }
        }
    }
    return sum;
}

// What the strips at obstacles add to the flow of this rank's cells (SurfaceShare).
double flow_at_surfaces(const Fluid::State& s, const Layers& layers) {
    if (!s.obstacles) return 0;
    double flow = 0;
    RowMoments m;
    for (const auto& [cell, share] : s.obstacles->surface_shares()) {
        const double weight =
            layers.weight(s.owned().lo[layers.axis] + cell[layers.axis]);
        if (weight == 0) continue;
        moments_in_time(s, {cell[1], cell[2], cell[0], cell[0] + 1}, m);
        for (int a = 0; a < 3; ++a)
            if (a != layers.axis) flow += weight * share[a] * m.j[layers.axis][0];
    }
    return flow;
}

}  // namespace

Totals Fluid::totals() const {
    return totals(std::vector{CellBox{{0, 0, 0}, state_->config.cells}});
}

Totals Fluid::totals(std::span<const CellBox> parts) const {
    const State& s = *state_;
    RowMoments m;
    Sums sum;
    double max_speed_squared = 0;
    each_row_of(s, parts, [&](const CellRow& row) {
        moments_in_time(s, row, m);
        add_row(m, sum, max_speed_squared);  // solid cells hold rest: no excess
        sum.cells += fluid_cells_of(s, row);
    });
    static_assert(sizeof sum == 7 * sizeof(double));
    sum_over_ranks(s.comm, &sum.excess, 7);
    sum_over_ranks(s.comm, &max_speed_squared, 1, MPI_MAX);

    const double mass = s.unit.cell_mass_kg(), speed = s.unit.velocity_m_s();
    Totals total;
    total.mass_kg = mass * (sum.cells + sum.excess);
    for (int a = 0; a < 3; ++a) total.momentum_kg_m_s[a] = mass * speed * sum.momentum[a];
    total.kinetic_energy_j = mass * speed * speed * sum.energy;
    total.sound_energy_j = mass * speed * speed * sum.sound;
    total.max_speed_m_s = speed * std::sqrt(max_speed_squared);
    return total;
}

PlaneFlow Fluid::plane_flow(int axis, double at_m) const {
    const State& s = *state_;
    const Layers layers = layers_at(axis, at_m / s.config.spacing_m, s.config.cells[axis],
                                    periodic_axes(s.config)[axis]);
    PlaneSums sum = sum_layers(s, layers);
    sum.flow += flow_at_surfaces(s, layers);
    static_assert(sizeof sum == 6 * sizeof(double));
    sum_over_ranks(s.comm, &sum.flow, 6);

    const Units& unit = s.unit;
    const double area = unit.spacing_m * unit.spacing_m, speed = unit.velocity_m_s();
    PlaneFlow out;
    out.flow_m3_s = sum.flow * speed * area;
    for (int a = 0; a < 3; ++a)
        out.momentum_flux_n[a] =
            sum.momentum[a] * unit.density_kg_m3 * speed * speed * area;
    out.pressure_pa = sum.cells > 0 ? sum.excess / sum.cells * unit.pressure_pa() : 0;
    return out;
}

std::vector<Vec3> Fluid::obstacle_forces() const {
    const State& s = *state_;
    if (!s.obstacles) return {};
    std::vector<Vec3> forces = s.obstacles->impulses();
    forces.resize(s.obstacles->count());
    const double dx = s.config.spacing_m;
    const double unit = s.unit.force_n_m3() * dx * dx * dx;
    for (Vec3& force : forces) {
        for (double& component : force) component *= unit;
    }
    sum_over_ranks(s.comm, forces[0].data(), static_cast<int>(3 * forces.size()));
    return forces;
}

void Fluid::macroscopic(std::span<float> velocity, std::span<float> density) const {
    const State& s = *state_;
    const std::size_t cells = s.cells();
    if (velocity.size() != 3 * cells || density.size() != cells) {
        refuse(
            "macroscopic() needs 3 velocity values and 1 density value for each of this "
            "rank's ",
            cells, " cells");
    }
    RowMoments m;
    std::size_t cell = 0;
    for (int z = 0; z < s.layout.nz; ++z) {
        for (int y = 0; y < s.layout.ny; ++y) {
            moments_in_time(s, {y, z, 0, s.layout.nx}, m);
            for (int x = 0; x < s.layout.nx; ++x, ++cell) {
                const double rho = 1 + m.excess[x];
                for (int a = 0; a < 3; ++a) {
                    const double u = m.j[a][x] / rho * s.unit.velocity_m_s();
                    velocity[3 * cell + a] = static_cast<float>(u);
                }
                density[cell] = static_cast<float>(s.unit.density_kg_m3 * rho);
            }
        }
    }
}

void Fluid::pressure(std::span<float> out) const {
    const State& s = *state_;
    if (out.size() != s.cells())
        refuse("pressure() needs 1 value for each of this rank's ", s.cells(), " cells");
    RowMoments m;
    std::size_t cell = 0;
    for (int z = 0; z < s.layout.nz; ++z) {
        for (int y = 0; y < s.layout.ny; ++y) {
            row_moments(s.view(), y, z, 0, s.layout.nx, m);
            for (int x = 0; x < s.layout.nx; ++x, ++cell)
                out[cell] = static_cast<float>(m.excess[x] * s.unit.pressure_pa());
        }
    }
}

}  // namespace magfsi::fluid
