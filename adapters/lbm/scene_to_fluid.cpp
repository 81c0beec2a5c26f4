#include "adapters/lbm/scene_to_fluid.h"

#include <cmath>

namespace magfsi::lbm {

namespace {

fluid::Collision to_collision(scene::Collision collision) {
    switch (collision) {
        case scene::Collision::automatic:
            return fluid::Collision::automatic;
        case scene::Collision::bgk:
            return fluid::Collision::bgk;
        case scene::Collision::recursive_regularized:
            return fluid::Collision::recursive_regularized;
    }
    return fluid::Collision::automatic;
}

fluid::Boundary to_boundary(const scene::Boundary& boundary) {
    const bool periodic = boundary.kind == scene::BoundaryKind::periodic;
    return {periodic ? fluid::BoundaryKind::periodic : fluid::BoundaryKind::no_slip,
            boundary.wall_velocity_m_s};
}

}  // namespace

fluid::FluidConfig to_config(const scene::Fluid& fluid, double time_step_s) {
    fluid::FluidConfig config;
    for (std::size_t d = 0; d < 3; ++d) {
        config.cells[d] = static_cast<int>(std::lround(fluid.box_m[d] / fluid.spacing_m));
    }
    config.spacing_m = fluid.spacing_m;
    config.time_step_s = time_step_s;
    config.density_kg_m3 = fluid.density_kg_m3;
    config.viscosity_m2_s = fluid.viscosity_m2_s;
    config.collision = to_collision(fluid.collision);
    for (std::size_t side = 0; side < 6; ++side) {
        config.boundaries[side] = to_boundary(fluid.boundaries[side]);
    }
    config.body_force_n_m3 = fluid.body_force_n_m3;
    if (fluid.initial_velocity_m_s) {
        const auto velocity = *fluid.initial_velocity_m_s;
        config.initial_velocity = [velocity](const fluid::Vec3&) { return velocity; };
    }
    return config;
}

}  // namespace magfsi::lbm
