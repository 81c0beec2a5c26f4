// SPDX-License-Identifier: GPL-2.0-or-later
// Fluids whose SI units are lattice units: spacing, step and density 1.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fluid_lbm/fluid.h"
#include "tests/support/checks.h"

namespace magfsi::fluid {

inline const auto every_collision =
    testing::Values(Collision::bgk, Collision::trt, Collision::recursive_regularized,
                    Collision::recursive_mrt);
inline const auto every_precision =
    testing::Values(Precision::double_, Precision::float_);

inline FluidConfig lattice_fluid(std::array<int, 3> cells, double relaxation_time,
                                 Collision collision) {
    FluidConfig config;
    config.cells = cells;
    config.spacing_m = config.time_step_s = config.density_kg_m3 = 1;
    config.viscosity_m2_s = (relaxation_time - 0.5) / 3;
    config.collision = collision;
    return config;
}

inline void set_walls(FluidConfig& config, int axis) {
    for (int side = 0; side < 2; ++side) {
        config.boundaries[2 * axis + side].kind = BoundaryKind::no_slip;
    }
}

inline std::vector<CellRow> all_rows(const Fluid& fluid) {
    std::vector<CellRow> rows;
    const CellBox box = fluid.owned();
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            rows.push_back({y, z, box.lo[0], box.hi[0]});
        }
    }
    return rows;
}

// Velocity of all owned cells, three values a cell, x fastest.
inline std::vector<double> velocity(const Fluid& fluid) {
    const std::vector<CellRow> rows = all_rows(fluid);
    std::vector<double> u(rows.size() * rows.front().size() * 3);
    fluid.velocity(rows, u);
    return u;
}

// Inlet by the side `in`, outlet by the opposite side; the other sides are walls of a
// kind.
inline FluidConfig channel(std::array<int, 3> cells, double relaxation_time, int in,
                           double speed, BoundaryKind around) {
    FluidConfig config = lattice_fluid(cells, relaxation_time, Collision::automatic);
    for (Boundary& side : config.boundaries) side.kind = around;
    const int axis = in / 2;
    config.boundaries[in].kind = BoundaryKind::velocity_inlet;
    config.boundaries[in].inlet.velocity_m_s[axis] = in % 2 == 0 ? speed : -speed;
    config.boundaries[in % 2 == 0 ? in + 1 : in - 1].kind = BoundaryKind::pressure_outlet;
    return config;
}

// use(cell, velocity) for all owned cells.
template <class Use>
void for_each_velocity(const Fluid& fluid, Use&& use) {
    const std::vector<double> u = velocity(fluid);
    std::size_t i = 0;
    for (const CellRow& row : all_rows(fluid)) {
        for (int x = row.x_begin; x < row.x_end; ++x, i += 3) {
            use(std::array<int, 3>{x, row.y, row.z}, Vec3{u[i], u[i + 1], u[i + 2]});
        }
    }
}

inline void advance(Fluid& fluid, int steps) {
    for (int i = 0; i < steps; ++i) fluid.step();
}

// A flow without any symmetry.
inline Vec3 stirred(const Vec3& x) {
    return {0.02 * std::sin(x[1] + x[2]), 0.02 * std::cos(x[0]), 0.01 * x[1] / 6};
}

// Whether any rank says so.
inline bool on_any_rank(bool here) {
    int any = here ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return any != 0;
}

void expect_refused(const auto& attempt, const std::string& wanted) {
    test::expect_refusal<std::invalid_argument>(attempt, {wanted});
}

}  // namespace magfsi::fluid
