#include "fluid_lbm/units.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace magfsi::fluid {

namespace {

const char* const axis_name[3] = {"x", "y", "z"};
const char* const side_name[6] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    throw std::invalid_argument(text.str());
}

void check_positive(const char* name, double value, const char* unit) {
    if (!(value > 0) || !std::isfinite(value)) {
        refuse("fluid ", name, " is ", value, " ", unit, "; it must be above 0");
    }
}

void check_relaxation_time(const FluidConfig& config) {
    const double tau = relaxation_time(config);
    if (!(tau > 0.5) || !std::isfinite(tau)) {
        refuse("fluid relaxation time 3 nu dt / dx^2 + 1/2 is ", tau, " with viscosity ",
               config.viscosity_m2_s,
               " m2/s; it must be above 0.5: use a positive viscosity and a longer time "
               "step or finer spacing");
    }
}

void check_sides(const FluidConfig& config) {
    for (int axis = 0; axis < 3; ++axis) {
        const bool low = config.boundaries[2 * axis].kind == BoundaryKind::periodic;
        const bool high = config.boundaries[2 * axis + 1].kind == BoundaryKind::periodic;
        if (low != high) {
            refuse("fluid side ", side_name[2 * axis + (low ? 0 : 1)],
                   " is periodic and the opposite side is not; both must be, or none");
        }
    }
}

void check_wall_velocity(const FluidConfig& config, int side) {
    const Boundary& boundary = config.boundaries[side];
    const Vec3& u = boundary.wall_velocity_m_s;
    const double speed = std::hypot(u[0], u[1], u[2]);
    if (!(speed >= 0) || !std::isfinite(speed)) {
        refuse("fluid wall velocity at ", side_name[side], " is not finite");
    }
    if (speed > 0 && boundary.kind == BoundaryKind::periodic) {
        refuse("fluid side ", side_name[side],
               " is periodic and has a wall velocity; only no-slip sides may have one");
    }
    if (u[side / 2] != 0) {
        refuse("fluid wall velocity at ", side_name[side], " has the component ",
               u[side / 2], " m/s along ", axis_name[side / 2],
               "; a wall may move only along itself");
    }
    const double lattice_speed = speed / units(config).velocity_m_s();
    if (lattice_speed > lattice_speed_limit) {
        refuse("fluid wall speed at ", side_name[side], " is ", lattice_speed,
               " cells a step; it must stay below ", lattice_speed_limit,
               ": use a shorter time step");
    }
}

}  // namespace

Units units(const FluidConfig& config) {
    return {config.spacing_m, config.time_step_s, config.density_kg_m3};
}

double relaxation_time(const FluidConfig& config) {
    return 3 * config.viscosity_m2_s * config.time_step_s /
               (config.spacing_m * config.spacing_m) +
           0.5;
}

void check(const FluidConfig& config) {
    for (int axis = 0; axis < 3; ++axis) {
        if (config.cells[axis] < 2) {
            refuse("fluid has ", config.cells[axis], " cells along ", axis_name[axis],
                   "; it needs at least 2");
        }
    }
    check_positive("spacing", config.spacing_m, "m");
    check_positive("time step", config.time_step_s, "s");
    check_positive("density", config.density_kg_m3, "kg/m3");
    check_relaxation_time(config);
    check_sides(config);
    for (int side = 0; side < 6; ++side) check_wall_velocity(config, side);
    if (config.body_force_n_m3) {
        for (double component : *config.body_force_n_m3) {
            if (!std::isfinite(component)) refuse("fluid body force is not finite");
        }
    }
}

}  // namespace magfsi::fluid
