// SPDX-License-Identifier: GPL-2.0-or-later
// Curl of the velocity, and the enstrophy.
#include <algorithm>
#include <cmath>

#include "fluid_lbm/refuse.h"
#include "fluid_lbm/state.h"

namespace magfsi::fluid {

namespace {

// The velocity of a rank's cells and of one layer of its neighbours' cells, for
// derivatives. Lattice units.
class VelocityField {
  public:
    // Copies the present velocity. Collective among neighbours.
    explicit VelocityField(const Fluid::State& state);

    // curl u in a cell by central differences. At walls it is the second-order one-sided
    // difference through the wall half a cell away; at sides with free slip, an inlet or
    // an outlet the velocity is taken not to change across the side.
    Vec3 curl(int x, int y, int z) const;
    // Adds |curl u|^2 / 2 of the fluid cells of a row to `sum`.
    void add_enstrophy_of_row(const CellRow& row, double& sum) const;

  private:
    // Address of a cell's velocity; y and z from -1 to ny and nz.
    double* at(int x, int y, int z) { return values_.data() + offset(x, y, z); }
    const double* at(int x, int y, int z) const {
        return values_.data() + offset(x, y, z);
    }
    std::size_t offset(int x, int y, int z) const;
    // Fills the layers beyond cut sides.
    void exchange();
    // Derivative of the velocity along an axis, per cell.
    Vec3 derivative(const Cell& cell, int axis) const;
    double enstrophy(int x, int y, int z) const;
    double enstrophy_of_row(const CellRow& row) const;  // without obstacles

    const Fluid::State& state_;
    const RowLayout& layout_;
    // Absent for sides that are no walls.
    std::array<std::optional<Vec3>, 6> wall_velocity_;
    std::vector<double> values_;  // [z][y][x][component]
};

VelocityField::VelocityField(const Fluid::State& state)
    : state_(state), layout_(state.layout) {
    for (int side = 0; side < 6; ++side) {
        if (state.config.boundaries[side].kind == BoundaryKind::no_slip)
            wall_velocity_[side] = wall_velocity(state.config, side);
    }
    const std::size_t rows = static_cast<std::size_t>(layout_.ny + 2) * (layout_.nz + 2);
    values_.resize(3 * rows * layout_.nx);
    RowMoments m;
    for (int z = 0; z < layout_.nz; ++z) {
        for (int y = 0; y < layout_.ny; ++y) {
            moments_in_time(state, {y, z, 0, layout_.nx}, m);
            double* to = at(0, y, z);
            for (int x = 0; x < layout_.nx; ++x) {
                const double volume = 1 / (1 + m.excess[x]);
                for (int a = 0; a < 3; ++a) *to++ = m.j[a][x] * volume;
            }
        }
    }
    exchange();
}

std::size_t VelocityField::offset(int x, int y, int z) const {
    const std::size_t row = static_cast<std::size_t>(z + 1) * (layout_.ny + 2) + (y + 1);
    return 3 * (row * layout_.nx + x);
}

void VelocityField::exchange() {
    const Decomposition& decomposition = state_.decomposition;
    const int row_size = 3 * layout_.nx;
    std::vector<double> sent, received;
    for (int axis = 1; axis <= 2; ++axis) {
        const int count = axis == 1 ? layout_.ny : layout_.nz;
        const int rows = axis == 1 ? layout_.nz : layout_.ny;
        const auto row_at = [&](int normal, int i) {
            return axis == 1 ? at(0, normal, i) : at(0, i, normal);
        };
        for (int side = 0; side < 2; ++side) {  // data leave by this side
            const int to = decomposition.neighbour(state_.comm.rank, axis, side);
            const int from = decomposition.neighbour(state_.comm.rank, axis, 1 - side);
            const auto peer = [](int r) { return r == no_rank ? MPI_PROC_NULL : r; };
            sent.resize(static_cast<std::size_t>(rows) * row_size);
            received.resize(sent.size());
            for (int i = 0; i < rows; ++i) {
                std::copy_n(row_at(side == 0 ? 0 : count - 1, i), row_size,
                            sent.data() + static_cast<std::size_t>(i) * row_size);
            }
            MPI_Sendrecv(sent.data(), sent.size(), MPI_DOUBLE, peer(to), side,
                         received.data(), received.size(), MPI_DOUBLE, peer(from), side,
                         state_.comm, MPI_STATUS_IGNORE);
            if (from == no_rank) continue;
            for (int i = 0; i < rows; ++i) {
                std::copy_n(received.data() + static_cast<std::size_t>(i) * row_size,
                            row_size, row_at(side == 0 ? count : -1, i));
            }
        }
    }
}

Vec3 VelocityField::derivative(const Cell& cell, int axis) const {
    const int counts[3] = {layout_.nx, layout_.ny, layout_.nz};
    const std::array<Beyond, 2> x_sides{layout_.beyond_x, layout_.beyond_x};
    const std::array<Beyond, 2>& sides = axis == 0   ? x_sides
                                         : axis == 1 ? layout_.beyond_y
                                                     : layout_.beyond_z;
    const double* here = at(cell[0], cell[1], cell[2]);
    const double* value[2] = {here, here};
    int wall_side = -1;
    for (int side = 0; side < 2; ++side) {
        std::array<int, 3> next = cell;
        next[axis] += side == 0 ? -1 : 1;
        const Crossing crossing = cross(next[axis], counts[axis], sides);
        next[axis] = crossing.index;
        if (crossing.wall) {
            if (wall_velocity_[2 * axis + side]) wall_side = side;
        } else {
            value[side] = at(next[0], next[1], next[2]);
        }
    }
    if (wall_side < 0) return 0.5 * (vector_at(value[1]) - vector_at(value[0]));
    // Parabola through -1/2 (wall), 0 and 1, at 0.
    const Vec3& wall = *wall_velocity_[2 * axis + wall_side];
    const Vec3 rise =
        -4.0 / 3 * wall + vector_at(here) + vector_at(value[1 - wall_side]) / 3;
    return wall_side == 0 ? rise : -rise;
}

Vec3 VelocityField::curl(int x, int y, int z) const {
    const Cell cell{x, y, z};
    const Vec3 dx = derivative(cell, 0);
    const Vec3 dy = derivative(cell, 1);
    const Vec3 dz = derivative(cell, 2);
    return {dy[2] - dz[1], dz[0] - dx[2], dx[1] - dy[0]};
}

double VelocityField::enstrophy(int x, int y, int z) const {
    const Vec3 w = curl(x, y, z);
    return 0.5 * dot(w, w);
}

void VelocityField::add_enstrophy_of_row(const CellRow& row, double& sum) const {
    if (!state_.obstacles) {
        sum += enstrophy_of_row(row);
        return;
    }
    for (int x = row.x_begin; x < row.x_end; ++x) {
        if (!state_.is_solid({x, row.y, row.z})) sum += enstrophy(x, row.y, row.z);
    }
}

double VelocityField::enstrophy_of_row(const CellRow& row) const {
    const auto [y, z, x_begin, x_end] = row;
    const Crossing south = cross(y - 1, layout_.ny, layout_.beyond_y),
                   north = cross(y + 1, layout_.ny, layout_.beyond_y),
                   below = cross(z - 1, layout_.nz, layout_.beyond_z),
                   above = cross(z + 1, layout_.nz, layout_.beyond_z);
    const bool at_wall = south.wall || north.wall || below.wall || above.wall;
    double sum = 0;
    // Cells at the ends of the grid's row, and all cells of a row beside a wall, take the
    // general way.
    for (int x = x_begin; x < x_end; ++x) {
        if (at_wall || x == 0 || x == layout_.nx - 1) sum += enstrophy(x, y, z);
    }
    if (at_wall) return sum;
    const double* const u = at(0, y, z);
    const double* const s = at(0, south.index, z);
    const double* const n = at(0, north.index, z);
    const double* const b = at(0, y, below.index);
    const double* const a = at(0, y, above.index);
    const int last = std::min(x_end, layout_.nx - 1);
    for (int x = std::max(x_begin, 1); x < last; ++x) {
        const int i = 3 * x;
        const double wx = (n[i + 2] - s[i + 2]) - (a[i + 1] - b[i + 1]);
        const double wy = (a[i] - b[i]) - (u[i + 5] - u[i - 1]);
        const double wz = (u[i + 4] - u[i - 2]) - (n[i] - s[i]);
        sum += 0.125 * (wx * wx + wy * wy + wz * wz);
    }
    return sum;
}

}  // namespace

double Fluid::enstrophy_1_s2() const {
    const Enstrophy whole =
        enstrophy(std::vector{CellBox{{0, 0, 0}, state_->config.cells}});
    return whole.integral_m3_s2 / whole.volume_m3;
}

Enstrophy Fluid::enstrophy(std::span<const CellBox> parts) const {
    const State& s = *state_;
    const VelocityField field(s);
    double sum[2] = {};  // enstrophy, cells
    each_row_of(s, parts, [&](const CellRow& row) {
        field.add_enstrophy_of_row(row, sum[0]);
        sum[1] += fluid_cells_of(s, row);
    });
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s.comm);
    const double cell_m3 = std::pow(s.config.spacing_m, 3);
    return {sum[0] * cell_m3 / std::pow(s.config.time_step_s, 2), sum[1] * cell_m3};
}

void Fluid::vorticity(std::span<float> out) const {
    const State& s = *state_;
    if (out.size() != 3 * s.cells()) {
        refuse("vorticity() needs 3 values for each of this rank's ", s.cells(),
               " cells");
    }
    const VelocityField field(s);
    const double unit = 1 / s.config.time_step_s;
    std::ranges::fill(out, 0.0F);
    std::size_t at = 0;
    for_each_cell({{0, 0, 0}, {s.layout.nx, s.layout.ny, s.layout.nz}},
                  [&](const Cell& cell) {
                      if (!s.is_solid(cell)) {
                          const Vec3 curl = field.curl(cell[0], cell[1], cell[2]);
                          for (std::size_t a = 0; a < 3; ++a)
                              out[at + a] = static_cast<float>(unit * curl[a]);
                      }
                      at += 3;
                  });
}

}  // namespace magfsi::fluid
