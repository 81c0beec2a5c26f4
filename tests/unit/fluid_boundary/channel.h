// Boxes with openings, in lattice units.
#pragma once

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {

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

}  // namespace magfsi::fluid
