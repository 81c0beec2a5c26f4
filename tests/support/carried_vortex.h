// SPDX-License-Identifier: GPL-2.0-or-later
// The two-dimensional Taylor-Green vortex, carried by a uniform stream or at rest: an
// exact solution of the Navier-Stokes equations in a box that is periodic along x and y.
// Spacing and step of the grid are 1; z is as thin as may be.
#pragma once

#include <cmath>
#include <numbers>

#include "fluid_lbm/refinement/refined_fluid.h"

namespace magfsi::fluid {

// A square of fluid in a vortex's velocity and pressure at time 0.
template <class Vortex>
FluidConfig config_of(const Vortex& vortex) {
    FluidConfig config;
    config.cells = {vortex.cells, vortex.cells, 1};
    config.spacing_m = config.time_step_s = config.density_kg_m3 = 1;
    config.viscosity_m2_s = vortex.viscosity();
    config.collision = Collision::recursive_regularized;
    config.initial_velocity = [vortex](const Vec3& x) { return vortex.velocity(x, 0); };
    config.initial_pressure = [vortex](const Vec3& x) { return vortex.pressure(x, 0); };
    return config;
}

struct CarriedVortex {
    int cells = 32;
    double relaxation_time = 0.8, speed = 0.05, stream = 0;

    double viscosity() const { return (relaxation_time - 0.5) / 3; }
    double wave() const { return 2 * std::numbers::pi / cells; }
    double left(double time) const {
        return speed * std::exp(-2 * wave() * wave() * viscosity() * time);
    }
    Vec3 velocity(const Vec3& at, double time) const {
        const double x = wave() * (at[0] - stream * time), y = wave() * at[1];
        return {stream - left(time) * std::sin(x) * std::cos(y),
                left(time) * std::cos(x) * std::sin(y), 0};
    }
    double pressure(const Vec3& at, double time) const {
        const double x = wave() * (at[0] - stream * time), y = wave() * at[1];
        return left(time) * left(time) / 4 * (std::cos(2 * x) + std::cos(2 * y));
    }

    FluidConfig config() const { return config_of(*this); }

    // The middle half of the box, moved along x.
    std::vector<BodyBox> middle(double moved) const {
        const double quarter = cells / 4.0, inset = 2 + 1e-6;
        return {{Vec3{quarter + inset + moved, quarter + inset, 0.1},
                 Vec3{3 * quarter - inset + moved, 3 * quarter - inset, 0.9}}};
    }
    RefinedConfig refined(int levels) const {
        return {.coarse = config(), .rule = {.levels = levels}};
    }

    // Error of the velocity in cells of this rank over that of the vortex at that time,
    // root of the mean square; over all ranks. in: cells of the level from the corner of
    // the whole box; first: of which the fluid's begin there.
    double error(const Fluid& fluid, const CellBox& in, const std::array<int, 3>& first,
                 double time) const {
        const double h = fluid.config().spacing_m;
        double sums[2] = {};
        const CellBox own = fluid.owned();
        for (int z = own.lo[2]; z < own.hi[2]; ++z) {
            for (int y = own.lo[1]; y < own.hi[1]; ++y) {
                const CellRow row{y, z, own.lo[0], own.hi[0]};
                std::vector<double> u(3 * static_cast<std::size_t>(row.size()));
                fluid.velocity(std::vector{row}, u);
                for (int x = row.x_begin; x < row.x_end; ++x) {
                    const std::array<int, 3> cell{x + first[0], y + first[1],
                                                  z + first[2]};
                    bool counts = true;
                    for (int d = 0; d < 3; ++d)
                        counts = counts && cell[d] >= in.lo[d] && cell[d] < in.hi[d];
                    if (!counts) continue;
                    const Vec3 exact = velocity(
                        {(cell[0] + 0.5) * h, (cell[1] + 0.5) * h, (cell[2] + 0.5) * h},
                        time);
                    for (int d = 0; d < 2; ++d) {
                        const double swirl = exact[d] - (d == 0 ? stream : 0);
                        sums[0] += std::pow(u[3 * (x - row.x_begin) + d] - exact[d], 2);
                        sums[1] += swirl * swirl;
                    }
                }
            }
        }
        MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        return std::sqrt(sums[0] / sums[1]);
    }
};

}  // namespace magfsi::fluid
