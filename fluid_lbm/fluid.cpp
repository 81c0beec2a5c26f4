#include "fluid_lbm/fluid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fluid_lbm/boundary/opening.h"
#include "fluid_lbm/collision/choice.h"
#include "fluid_lbm/initial_flow.h"
#include "fluid_lbm/obstacle/check_obstacles.h"
#include "fluid_lbm/parallel/gathered.h"
#include "fluid_lbm/sampling/divergence.h"
#include "fluid_lbm/sampling/plane_flow.h"
#include "fluid_lbm/sampling/state.h"
#include "fluid_lbm/sampling/totals.h"
#include "fluid_lbm/sampling/velocity_field.h"
#include "fluid_lbm/solver.h"
#include "fluid_lbm/streaming/kernel_choice.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

namespace {

FluidConfig checked(const FluidConfig& config) {
    check(config);
    return config;
}

Vec3 scaled(const Vec3& v, double factor) {
    return {v[0] * factor, v[1] * factor, v[2] * factor};
}

SolverConfig in_lattice_units(const FluidConfig& config, const KernelSet& kernels) {
    const Units unit = units(config);
    SolverConfig lattice;
    lattice.cells = config.cells;
    lattice.collision.omega = 1 / relaxation_time(config);
    lattice.collision.magic = choose_magic_number(config);
    lattice.collision.eddy_constant = config.smagorinsky_constant;
    lattice.kernels = run_kernels(kernels, config.precision, choose_collision(config),
                                  config.smagorinsky_constant > 0);
    for (int side = 0; side < 6; ++side) {
        const Boundary& boundary = config.boundaries[side];
        lattice.periodic[side / 2] = boundary.kind == BoundaryKind::periodic;
        lattice.wall_velocity[side] =
            scaled(boundary.wall_velocity_m_s, 1 / unit.velocity_m_s());
        lattice.sides[side] = lattice_side(config, side);
    }
    lattice.solids = make_solids(config);
    lattice.obstacle_wall = config.obstacle_wall;
    if (config.body_force_n_m3) {
        lattice.body_force = scaled(*config.body_force_n_m3, 1 / unit.force_n_m3());
    }
    return lattice;
}

// A communicator of the fluid's own: its messages cannot meet those of its user.
class OwnedComm {
  public:
    explicit OwnedComm(MPI_Comm comm) { MPI_Comm_dup(comm, &comm_); }
    ~OwnedComm() {
        int finalized = 0;
        MPI_Finalized(&finalized);
        if (finalized == 0) MPI_Comm_free(&comm_);
    }
    OwnedComm(const OwnedComm&) = delete;
    OwnedComm& operator=(const OwnedComm&) = delete;
    MPI_Comm get() const { return comm_; }

  private:
    MPI_Comm comm_ = MPI_COMM_NULL;
};

}  // namespace

struct Fluid::State {
    State(MPI_Comm parent, const FluidConfig& fluid_config)
        : config(checked(fluid_config)),
          collision(choose_collision(config)),
          kernels(choose_kernels()),
          lattice(in_lattice_units(config, kernels.kernels)),
          comm(parent),
          solver(comm.get(), lattice) {
        if (solver.obstacles()) {
            check_resolved(comm.get(), config, solver.obstacles()->map());
        }
        set_initial_flow(config, solver);
        solver.settle_obstacles();
    }

    // Throws unless the plane is this rank's and has that many values.
    int local_plane(int plane, std::size_t values) const;

    std::size_t cells() const {  // of this rank
        const RowLayout& rows = solver.layout();
        return static_cast<std::size_t>(rows.nx) * rows.ny * rows.nz;
    }
    // Throws if the rows leave this rank's box or the values do not match them.
    void check_rows(std::span<const CellRow> rows, std::size_t values) const;

    FluidConfig config;
    Collision collision;
    NamedKernels kernels;
    SolverConfig lattice;
    OwnedComm comm;
    Solver solver;
};

void Fluid::State::check_rows(std::span<const CellRow> rows, std::size_t values) const {
    const CellBox& box = solver.owned();
    std::size_t cells = 0;
    for (const CellRow& row : rows) {
        const bool inside = row.y >= box.lo[1] && row.y < box.hi[1] &&
                            row.z >= box.lo[2] && row.z < box.hi[2] && row.x_begin >= 0 &&
                            row.x_begin <= row.x_end && row.x_end <= box.hi[0];
        if (!inside) {
            throw std::invalid_argument("row of cells y " + std::to_string(row.y) +
                                        ", z " + std::to_string(row.z) + ", x " +
                                        std::to_string(row.x_begin) + " to " +
                                        std::to_string(row.x_end) +
                                        " is not inside this rank's box of the fluid");
        }
        cells += row.size();
    }
    if (values != 3 * cells) {
        throw std::invalid_argument(std::to_string(values) + " values were given for " +
                                    std::to_string(cells) +
                                    " cells; 3 a cell are needed");
    }
}

int Fluid::State::local_plane(int plane, std::size_t values) const {
    const CellBox& box = solver.owned();
    const RowLayout& rows = solver.layout();
    const std::size_t wanted = populations_a_cell * static_cast<std::size_t>(rows.nx) *
                               static_cast<std::size_t>(rows.ny);
    if (plane < box.lo[2] || plane >= box.hi[2] || values != wanted) {
        throw std::invalid_argument(
            "plane z " + std::to_string(plane) + " with " + std::to_string(values) +
            " values was given; planes " + std::to_string(box.lo[2]) + " to " +
            std::to_string(box.hi[2] - 1) + " of this rank have " +
            std::to_string(wanted));
    }
    return plane - box.lo[2];
}

Fluid::Fluid(MPI_Comm comm, const FluidConfig& config)
    : state_(std::make_unique<State>(comm, config)) {}
Fluid::~Fluid() = default;

const FluidConfig& Fluid::config() const {
    return state_->config;
}
double Fluid::relaxation_time() const {
    return fluid::relaxation_time(state_->config);
}
Collision Fluid::collision() const {
    return state_->collision;
}
std::string Fluid::kernel() const {
    return state_->kernels.name;
}
CellBox Fluid::owned() const {
    return state_->solver.owned();
}
const std::vector<CellBox>& Fluid::owned_by_rank() const {
    return state_->solver.decomposition().boxes;
}
double Fluid::waited_for_neighbors_s() const {
    return state_->solver.waited_for_neighbors_s();
}

std::size_t Fluid::memory_bytes() const {
    const Obstacles* obstacles = state_->solver.obstacles();
    return state_->solver.populations().bytes() + state_->solver.kept_bytes() +
           state_->solver.force_bytes() + (obstacles ? obstacles->bytes() : 0);
}

std::vector<CellRow> Fluid::solid_rows() const {
    if (!state_->solver.obstacles()) return {};
    const CellBox& box = state_->solver.owned();
    std::vector<int> mine;  // y, z, x_begin, x_end
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            const auto solid = [&](int x) {
                return state_->solver.is_solid({x, y - box.lo[1], z - box.lo[2]});
            };
            for (int x = box.lo[0]; x < box.hi[0]; ++x) {
                if (!solid(x)) continue;
                const int begin = x;
                while (x < box.hi[0] && solid(x)) ++x;
                mine.insert(mine.end(), {y, z, begin, x});
            }
        }
    }
    const std::vector<int> all = gathered(state_->comm.get(), mine);
    std::vector<CellRow> rows;
    for (std::size_t i = 0; i < all.size(); i += 4)
        rows.push_back({all[i], all[i + 1], all[i + 2], all[i + 3]});
    return rows;
}

void Fluid::velocity(std::span<const CellRow> rows, std::span<double> out) const {
    state_->check_rows(rows, out.size());
    const CellBox& box = state_->solver.owned();
    const double unit = units(state_->config).velocity_m_s();
    RowMoments m;
    double* to = out.data();
    for (const CellRow& row : rows) {
        row_moments(state_->solver.view(), row.y - box.lo[1], row.z - box.lo[2],
                    row.x_begin, row.x_end, m);
        for (int i = 0; i < row.size(); ++i) {
            const double factor = unit / (1 + m.excess[i]);
            for (int a = 0; a < 3; ++a) *to++ = factor * m.j[a][i];
        }
    }
}

void Fluid::set_force(std::span<const CellRow> rows, std::span<const double> force) {
    state_->check_rows(rows, force.size());
    const CellBox& box = state_->solver.owned();
    const double factor = 1 / units(state_->config).force_n_m3();
    ForcedRows& forces = state_->solver.forces();
    forces.clear();
    std::size_t first = 0;
    for (const CellRow& row : rows) {
        const std::size_t count = 3 * static_cast<std::size_t>(row.size());
        forces.add(row.y - box.lo[1], row.z - box.lo[2], row.x_begin,
                   force.subspan(first, count), factor);
        first += count;
    }
}

void Fluid::vorticity(std::span<float> out) const {
    const RowLayout& layout = state_->solver.layout();
    const std::size_t cells = state_->cells();
    if (out.size() != 3 * cells) {
        throw std::invalid_argument(
            "vorticity() needs 3 values for each of this rank's " +
            std::to_string(cells) + " cells");
    }
    const VelocityField field = sample_velocity(state_->comm.get(), state_->solver);
    const double unit = 1 / state_->config.time_step_s;
    std::ranges::fill(out, 0.0F);
    state_->solver.each_fluid_cell([&](int x, int y, int z) {
        const Vec3 curl = field.curl(x, y, z, state_->lattice.wall_velocity);
        const std::size_t cell =
            (static_cast<std::size_t>(z) * layout.ny + y) * layout.nx + x;
        for (std::size_t a = 0; a < 3; ++a)
            out[3 * cell + a] = static_cast<float>(unit * curl[a]);
    });
}

void Fluid::step() {
    state_->solver.step();
}

void Fluid::keep() {
    state_->solver.keep();
}

void Fluid::go_back() {
    state_->solver.go_back();
}

std::int64_t Fluid::steps_done() const {
    return state_->solver.steps_done();
}

void Fluid::populations(int plane, std::span<double> values) const {
    read_plane(state_->solver.view(), state_->local_plane(plane, values.size()), values);
}

void Fluid::set_steps_done(std::int64_t steps) {
    state_->solver.set_steps_done(steps);
}

void Fluid::set_populations(int plane, std::span<const double> values) {
    write_plane(state_->solver.view(), state_->local_plane(plane, values.size()), values);
}

Totals Fluid::totals() const {
    return fluid::totals(state_->comm.get(), state_->solver, units(state_->config));
}

double Fluid::enstrophy_1_s2() const {
    return mean_enstrophy(state_->comm.get(), state_->solver,
                          state_->lattice.wall_velocity) /
           std::pow(state_->config.time_step_s, 2);
}

PlaneFlow Fluid::plane_flow(int axis, double at_m) const {
    return fluid::plane_flow(state_->comm.get(), state_->solver, units(state_->config),
                             axis, at_m / state_->config.spacing_m);
}

std::vector<Vec3> Fluid::obstacle_forces() const {
    std::vector<Vec3> forces(state_->config.obstacles.size());
    if (forces.empty()) return forces;
    forces = state_->solver.obstacles()->impulses();
    const double dx = state_->config.spacing_m;
    const double unit = units(state_->config).force_n_m3() * dx * dx * dx;
    for (Vec3& force : forces) force = scaled(force, unit);
    MPI_Allreduce(MPI_IN_PLACE, forces.data(), static_cast<int>(3 * forces.size()),
                  MPI_DOUBLE, MPI_SUM, state_->comm.get());
    return forces;
}

std::optional<Divergence> Fluid::divergence() const {
    return find_divergence(state_->solver, state_->config);
}

std::optional<Divergence> Fluid::diverged() const {
    const auto& found = state_->solver.unsound();
    if (!found) return std::nullopt;
    return describe(*found, state_->solver, state_->config);
}

void Fluid::macroscopic(std::span<float> velocity, std::span<float> density) const {
    const RowLayout& layout = state_->solver.layout();
    const std::size_t cells = state_->cells();
    if (velocity.size() != 3 * cells || density.size() != cells) {
        throw std::invalid_argument(
            "macroscopic() needs 3 velocity values and 1 density "
            "value for each of this rank's " +
            std::to_string(cells) + " cells");
    }
    const Units unit = units(state_->config);
    RowMoments m;
    std::size_t cell = 0;
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            row_moments(state_->solver.view(), y, z, 0, layout.nx, m);
            for (int x = 0; x < layout.nx; ++x, ++cell) {
                const double rho = 1 + m.excess[x];
                for (int a = 0; a < 3; ++a) {
                    const double u = m.j[a][x] / rho * unit.velocity_m_s();
                    velocity[3 * cell + a] = static_cast<float>(u);
                }
                density[cell] = static_cast<float>(unit.density_kg_m3 * rho);
            }
        }
    }
}

}  // namespace magfsi::fluid
