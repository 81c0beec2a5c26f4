// Fluids whose SI units are lattice units: spacing, step and density 1.
#pragma once

#include <vector>

#include "fluid_lbm/fluid.h"

namespace magfsi::fluid {

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

}  // namespace magfsi::fluid
