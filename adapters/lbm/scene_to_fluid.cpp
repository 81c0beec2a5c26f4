#include "adapters/lbm/scene_to_fluid.h"

#include <cmath>
#include <numbers>

namespace magfsi::lbm {

namespace {

fluid::Collision to_collision(scene::Collision collision) {
    switch (collision) {
        case scene::Collision::automatic:
            return fluid::Collision::automatic;
        case scene::Collision::bgk:
            return fluid::Collision::bgk;
        case scene::Collision::trt:
            return fluid::Collision::trt;
        case scene::Collision::recursive_regularized:
            return fluid::Collision::recursive_regularized;
    }
    return fluid::Collision::automatic;
}

fluid::Precision to_precision(scene::Precision precision) {
    switch (precision) {
        case scene::Precision::double_:
            return fluid::Precision::double_;
        case scene::Precision::float_:
            return fluid::Precision::float_;
        case scene::Precision::float_double:
            return fluid::Precision::float_double;
    }
    return fluid::Precision::double_;
}

fluid::InletProfile to_profile(scene::InletProfile profile) {
    switch (profile) {
        case scene::InletProfile::uniform:
            return fluid::InletProfile::uniform;
        case scene::InletProfile::parabolic:
            return fluid::InletProfile::parabolic;
        case scene::InletProfile::plug:
            return fluid::InletProfile::plug;
    }
    return fluid::InletProfile::uniform;
}

fluid::Boundary to_boundary(const scene::Boundary& side) {
    fluid::Boundary out;
    switch (side.kind) {
        case scene::BoundaryKind::periodic:
            out.kind = fluid::BoundaryKind::periodic;
            break;
        case scene::BoundaryKind::no_slip:
            out.kind = fluid::BoundaryKind::no_slip;
            out.wall_velocity_m_s = side.velocity_m_s;
            break;
        case scene::BoundaryKind::free_slip:
            out.kind = fluid::BoundaryKind::free_slip;
            break;
        case scene::BoundaryKind::velocity_inlet:
            out.kind = fluid::BoundaryKind::velocity_inlet;
            out.inlet = {side.velocity_m_s, to_profile(side.profile), side.ramp_s, {}};
            break;
        case scene::BoundaryKind::pressure_outlet:
            out.kind = fluid::BoundaryKind::pressure_outlet;
            out.outlet_pressure_pa = side.pressure_pa;
            break;
    }
    if (const auto* rectangle = std::get_if<scene::Rectangle>(&side.patch))
        out.patch = fluid::Rectangle{rectangle->centre_m, rectangle->size_m};
    if (const auto* disc = std::get_if<scene::Disc>(&side.patch))
        out.patch = fluid::Disc{disc->centre_m, disc->diameter_m};
    return out;
}

fluid::ObstacleShape to_shape(const scene::Obstacle& obstacle) {
    if (const auto* ball = std::get_if<scene::Sphere>(&obstacle.shape))
        return fluid::Sphere{ball->centre_m, ball->diameter_m};
    if (const auto* rod = std::get_if<scene::Cylinder>(&obstacle.shape))
        return fluid::Cylinder{rod->centre_m, rod->diameter_m, rod->axis, rod->length_m};
    if (const auto* block = std::get_if<scene::Block>(&obstacle.shape))
        return fluid::Block{block->corners_m[0], block->corners_m[1]};
    const auto& surface = std::get<scene::StlSurface>(obstacle.shape);
    return fluid::StlSurface{surface.file, surface.unit_m, surface.shift_m};
}

// The pressure is that of the incompressible flow: rho U^2 / 16 (cos 2kx + cos 2ky)
// (cos 2kz + 2).
void start_as_taylor_green(fluid::FluidConfig& config, const scene::Fluid& fluid) {
    const double speed_m_s = fluid.taylor_green->speed_m_s;
    const double k = 2 * std::numbers::pi / fluid.box_m[0];
    const double pressure_pa = fluid.density_kg_m3 * speed_m_s * speed_m_s / 16;
    config.initial_velocity = [=](const fluid::Vec3& x) {
        const double u = speed_m_s * std::cos(k * x[2]);
        return fluid::Vec3{u * std::sin(k * x[0]) * std::cos(k * x[1]),
                           -u * std::cos(k * x[0]) * std::sin(k * x[1]), 0};
    };
    config.initial_pressure = [=](const fluid::Vec3& x) {
        return pressure_pa * (std::cos(2 * k * x[0]) + std::cos(2 * k * x[1])) *
               (std::cos(2 * k * x[2]) + 2);
    };
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
    config.precision = to_precision(fluid.precision);
    config.magic_number = fluid.magic_number;
    if (fluid.smagorinsky) config.smagorinsky_constant = fluid.smagorinsky->constant;
    for (const scene::Obstacle& obstacle : fluid.obstacles)
        config.obstacles.push_back({obstacle.name, to_shape(obstacle)});
    for (std::size_t side = 0; side < 6; ++side) {
        config.boundaries[side] = to_boundary(fluid.boundaries[side]);
    }
    config.body_force_n_m3 = fluid.body_force_n_m3;
    if (fluid.initial_velocity_m_s) {
        const auto velocity = *fluid.initial_velocity_m_s;
        config.initial_velocity = [velocity](const fluid::Vec3&) { return velocity; };
    }
    if (fluid.taylor_green) start_as_taylor_green(config, fluid);
    return config;
}

}  // namespace magfsi::lbm
