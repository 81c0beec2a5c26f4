// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/fluid.h"

#include <algorithm>
#include <numeric>

#include "fluid_lbm/lattice/equilibrium.h"
#include "fluid_lbm/refuse.h"
#include "fluid_lbm/state.h"

namespace magfsi::fluid {

namespace {

// The configuration itself, after check() has accepted it.
FluidConfig checked(const FluidConfig& config) {
    check(config);
    return config;
}

// The values of all ranks, in the order of the ranks, on every rank. Collective.
std::vector<int> gathered(const OwnedComm& comm, const std::vector<int>& mine) {
    const int count = mine.size();
    std::vector<int> counts(comm.size), first(counts);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
    std::exclusive_scan(counts.begin(), counts.end(), first.begin(), 0);
    std::vector<int> all(first.back() + counts.back());
    MPI_Allgatherv(mine.data(), count, MPI_INT, all.data(), counts.data(), first.data(),
                   MPI_INT, comm);
    return all;
}

// Initial flow of a cell in lattice units. The velocity is that of the sum of c f, so
// half of the body force is taken off (Guo, Zheng, Shi 2002). The gradient is taken by
// central differences over one cell: the user's functions are asked only for points
// inside the box or on its sides.
LocalFlow flow_at(const FluidConfig& config, const Vec3& centre_m) {
    const Units unit = units(config);
    LocalFlow flow;
    if (config.initial_pressure) {
        flow.density_excess = config.initial_pressure(centre_m) / unit.pressure_pa();
    }
    flow.velocity = -half_body_force(config) / (1 + flow.density_excess);
    if (!config.initial_velocity) return flow;
    flow.velocity += config.initial_velocity(centre_m) / unit.velocity_m_s();
    for (int b = 0; b < 3; ++b) {
        Vec3 low = centre_m, high = centre_m;
        low[b] -= config.spacing_m / 2;
        high[b] += config.spacing_m / 2;
        const Vec3 u_low = config.initial_velocity(low);
        const Vec3 u_high = config.initial_velocity(high);
        for (int a = 0; a < 3; ++a) {
            flow.gradient[a][b] = (u_high[a] - u_low[a]) / unit.velocity_m_s();
        }
    }
    return flow;
}

// Adds `share` of the divergence to the gradient, without change of the rate of strain's
// other part.
void scale_divergence(LocalFlow& flow, double share) {
    auto& g = flow.gradient;
    const double mean = share * (g[0][0] + g[1][1] + g[2][2]) / 3;
    for (std::size_t a = 0; a < 3; ++a) g[a][a] += mean;
}

// Throws std::invalid_argument if a row leaves the rank's box or the number of values
// does not fit the rows.
void check_rows(const CellBox& box, std::span<const CellRow> rows, std::size_t values,
                std::size_t values_per_cell = 3) {
    std::size_t cells = 0;
    for (const CellRow& row : rows) {
        const bool inside = row.y >= box.lo[1] && row.y < box.hi[1] &&
                            row.z >= box.lo[2] && row.z < box.hi[2] && row.x_begin >= 0 &&
                            row.x_begin <= row.x_end && row.x_end <= box.hi[0];
        if (!inside) {
            refuse("row of cells y ", row.y, ", z ", row.z, ", x ", row.x_begin, " to ",
                   row.x_end, " is not inside this rank's box of the fluid");
        }
        cells += row.size();
    }
    if (values != values_per_cell * cells) {
        refuse(values, " values were given for ", cells, " cells; ", values_per_cell,
               " per cell are needed");
    }
}

// Local index of a global plane z. Throws std::invalid_argument if the plane is not this
// rank's or `values` is not its number of populations.
int local_plane(const Fluid::State& s, int plane, std::size_t values) {
    const CellBox& box = s.owned();
    const std::size_t wanted = populations_per_cell *
                               static_cast<std::size_t>(s.layout.nx) *
                               static_cast<std::size_t>(s.layout.ny);
    if (plane < box.lo[2] || plane >= box.hi[2] || values != wanted) {
        refuse("plane z ", plane, " with ", values, " values was given; planes ",
               box.lo[2], " to ", box.hi[2] - 1, " of this rank have ", wanted);
    }
    return plane - box.lo[2];
}

// The rows of `all` without the outermost layer at sides that the caller fills again
// (FluidConfig::refilled), as far as this rank's box reaches these sides.
Fluid::State::Needed without_refilled(const FluidConfig& config, const CellBox& own,
                                      const Fluid::State::Needed& all) {
    const auto first = [&](int axis) {
        return config.refilled[2 * axis] && own.lo[axis] == 0 ? 1 : 0;
    };
    const auto end = [&](int axis) {
        const bool outer =
            config.refilled[2 * axis + 1] && own.hi[axis] == config.cells[axis];
        return own.hi[axis] - own.lo[axis] - (outer ? 1 : 0);
    };
    const RowBox rows{first(1), end(1), first(2), end(2)};
    return {clipped(all.at_cuts, rows), clipped(all.inner, rows),
            !(config.refilled[0] && config.refilled[1])};
}

// The source of a viscosity that varies from cell to cell; a rheology excludes eddies.
LocalViscosity local_viscosity(const FluidConfig& config) {
    if (config.rheology) return LocalViscosity::rheology;
    return config.smagorinsky_constant > 0 ? LocalViscosity::eddies
                                           : LocalViscosity::none;
}

}  // namespace

OwnedComm::OwnedComm(MPI_Comm parent) {
    MPI_Comm_dup(parent, &comm);
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
}
OwnedComm::~OwnedComm() {
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (finalized == 0) MPI_Comm_free(&comm);
}

Fluid::State::State(MPI_Comm parent, const FluidConfig& fluid_config)
    : config(checked(fluid_config)),
      unit(units(config)),
      rate_table(config.rheology
                     ? rates_by_stress(*config.rheology, config.viscosity_m2_s, unit)
                     : std::vector<double>{}),
      parameters{1 / relaxation_time(config), choose_magic_number(config),
                 config.smagorinsky_constant, rate_table.data(),
                 1 / trace_relaxation_time(config).value_or(1)},
      kernels(choose_kernels(
          choose_instruction_set(), config.precision, choose_collision(config),
          local_viscosity(config),
          config.bulk_viscosity_m2_s ? TraceRate::own : TraceRate::viscous)),
      comm(parent),
      decomposition(decompose(config.cells, periodic_axes(config), comm.size)),
      layout(decomposition.layout(comm.rank)),
      populations(layout.nx, layout.row_count(), config.precision),
      halo(comm, decomposition, comm.rank, populations),
      needed_from_natural{rows_at_cuts(layout), inner_rows(layout)},
      needed_from_swapped(without_refilled(config, owned(), needed_from_natural)) {
    if (!config.obstacles.empty())
        obstacles.emplace(config, make_solids(config), owned(), populations, layout);
    side_effects = make_side_effects({comm, config, decomposition, comm.rank, populations,
                                      layout, obstacles ? &obstacles->map() : nullptr});
    if (config.body_force_n_m3) {
        Vec3 force = *config.body_force_n_m3;
        for (double& component : force) component *= 1 / unit.force_n_m3();
        need_forces(force);
    }
    if (obstacles && !config.is_patch) check_resolved(comm, config, obstacles->map());
    set_initial_flow();
    reset_solid_cells();
}

CellBox Fluid::State::local_part(const CellBox& box) const {
    const CellBox& own = owned();
    CellBox part;
    for (int d = 0; d < 3; ++d) {
        part.lo[d] = std::max(box.lo[d], own.lo[d]) - own.lo[d];
        part.hi[d] = std::max(std::min(box.hi[d], own.hi[d]) - own.lo[d], part.lo[d]);
    }
    return part;
}

void Fluid::State::need_forces(const std::optional<Vec3>& body_force) {
    if (!forces)
        forces.emplace(layout.nx, layout.ny, layout.nz, body_force, config.precision);
}

void Fluid::State::reset_solid_cells() {
    if (obstacles) obstacles->reset_solid_cells(populations, layout, arrangement);
}

void Fluid::State::set_initial_flow() {
    if (!config.initial_velocity && !config.initial_pressure && !config.body_force_n_m3)
        return;
    const double tau = relaxation_time(config);
    // Compression takes the relaxation time of the trace.
    const double trace_share = trace_relaxation_time(config).value_or(tau) / tau - 1;
    populations.visit([&]<class Real>(const PopulationRows<Real>& rows) {
        for_each_cell({{0, 0, 0}, {layout.nx, layout.ny, layout.nz}}, [&](const Cell& x) {
            Vec3 centre_m;
            for (int a = 0; a < 3; ++a)
                centre_m[a] = (owned().lo[a] + x[a] + 0.5) * config.spacing_m;
            LocalFlow flow = flow_at(config, centre_m);
            if (config.bulk_viscosity_m2_s) scale_divergence(flow, trace_share);
            const int row = layout.row(x[1], x[2]);
            for (int q = 0; q < d3q19::directions; ++q)
                rows.row(q, row)[x[0]] = static_cast<Real>(flow_population(q, flow, tau));
        });
    });
}

Fluid::Fluid(MPI_Comm comm, const FluidConfig& config)
    : state_(std::make_unique<State>(comm, config)) {}
Fluid::~Fluid() = default;

const FluidConfig& Fluid::config() const {
    return state_->config;
}
CellBox Fluid::owned() const {
    return state_->owned();
}
const std::vector<CellBox>& Fluid::owned_by_rank() const {
    return state_->decomposition.boxes;
}
double Fluid::waited_for_neighbours_s() const {
    return state_->halo.waited_s();
}

std::vector<CellRow> Fluid::solid_rows() const {
    if (!state_->obstacles) return {};
    const CellBox& box = state_->owned();
    std::vector<int> mine;  // y, z, x_begin, x_end
    for (const CellRow& row : state_->obstacles->rows())
        mine.insert(mine.end(),
                    {box.lo[1] + row.y, box.lo[2] + row.z, row.x_begin, row.x_end});
    const std::vector<int> all = gathered(state_->comm, mine);
    std::vector<CellRow> rows;
    for (std::size_t i = 0; i < all.size(); i += 4)
        rows.push_back({all[i], all[i + 1], all[i + 2], all[i + 3]});
    return rows;
}

void Fluid::velocity(std::span<const CellRow> rows, std::span<double> out,
                     std::span<double> relative_density) const {
    const CellBox& box = state_->owned();
    check_rows(box, rows, out.size());
    if (!relative_density.empty()) check_rows(box, rows, relative_density.size(), 1);
    const double unit = state_->unit.velocity_m_s();
    RowMoments m;
    double* to = out.data();
    double* density = relative_density.data();
    for (const CellRow& row : rows) {
        row_moments(state_->view(), row.y - box.lo[1], row.z - box.lo[2], row.x_begin,
                    row.x_end, m);
        for (int i = 0; i < row.size(); ++i) {
            const double factor = unit / (1 + m.excess[i]);
            for (int a = 0; a < 3; ++a) *to++ = factor * m.j[a][i];
        }
        if (relative_density.empty()) continue;
        for (int i = 0; i < row.size(); ++i) *density++ = 1 + m.excess[i];
    }
}

void Fluid::set_force(std::span<const CellRow> rows, std::span<const double> force) {
    const CellBox& box = state_->owned();
    check_rows(box, rows, force.size());
    const double factor = 1 / state_->unit.force_n_m3();
    state_->need_forces({});
    ForcedRows& forces = *state_->forces;
    forces.clear();
    std::size_t first = 0;
    for (const CellRow& row : rows) {
        const std::size_t count = 3 * static_cast<std::size_t>(row.size());
        forces.add(row.y - box.lo[1], row.z - box.lo[2], row.x_begin,
                   force.subspan(first, count), factor);
        first += count;
    }
}

void Fluid::populations(int plane, std::span<double> values) const {
    read_plane(state_->view(), local_plane(*state_, plane, values.size()), values);
}

void Fluid::set_populations(int plane, std::span<const double> values) {
    write_plane(state_->view(), local_plane(*state_, plane, values.size()), values);
}

}  // namespace magfsi::fluid
