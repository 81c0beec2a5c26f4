// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/config.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/fitted/constants.h"
#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/collision/bulk_viscosity.h"
#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/collision/choice.h"
#include "fluid_lbm/obstacle/solid.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// The quantities beside the options on which the choice of the collision depends.
CollisionCase collision_case(const FluidConfig& config) {
    const double tau = relaxation_time(config);
    return {
        tau, config.holds_no_slip,
        cell_reynolds_number(config, config.expected_speed_m_s, config.spacing_m, tau),
        has_moving_wall(config, config.spacing_m, tau)};
}

}  // namespace

Units units(const FluidConfig& config) {
    return {config.spacing_m, config.time_step_s, config.density_kg_m3};
}

double relaxation_time(const FluidConfig& config) {
    return relaxation_time(config.viscosity_m2_s, config.time_step_s, config.spacing_m);
}

std::optional<double> trace_relaxation_time(const FluidConfig& config) {
    if (!config.bulk_viscosity_m2_s) return {};
    return trace_relaxation_time(*config.bulk_viscosity_m2_s, config.time_step_s,
                                 config.spacing_m);
}

std::array<bool, 3> periodic_axes(const FluidConfig& config) {
    std::array<bool, 3> periodic{};
    for (int axis = 0; axis < 3; ++axis)
        periodic[axis] = config.boundaries[2 * axis].kind == BoundaryKind::periodic;
    return periodic;
}

bool sweep_is_all(const FluidConfig& config) {
    const auto plain = [](const Boundary& side) {
        return side.kind == BoundaryKind::periodic ||
               (side.kind == BoundaryKind::no_slip && side.wall_velocity_m_s == Vec3{});
    };
    return std::ranges::all_of(config.boundaries, plain) && config.obstacles.empty() &&
           !config.body_force_n_m3;
}

Vec3 wall_velocity(const FluidConfig& config, int side) {
    Vec3 velocity = config.boundaries[side].wall_velocity_m_s;
    for (double& u : velocity) u *= 1 / units(config).velocity_m_s();
    return velocity;
}

Vec3 half_body_force(const FluidConfig& config) {
    Vec3 half = config.body_force_n_m3.value_or(Vec3{});
    for (double& f : half) f *= 0.5 / units(config).force_n_m3();
    return half;
}

Collision choose_collision(const FluidConfig& config) {
    return choose_collision(config, collision_case(config));
}

double choose_magic_number(const FluidConfig& config) {
    return choose_magic_number(config, collision_case(config));
}

double odd_rate(const FluidConfig& config) {
    return odd_rate(1 / relaxation_time(config), choose_magic_number(config));
}

std::string collision_reason(const FluidConfig& config) {
    const double tau = relaxation_time(config);
    const Collision chosen = choose_collision(config);
    std::ostringstream text;
    text.precision(4);
    text << name_of(chosen);
    if (chosen != Collision::bgk && chosen != Collision::recursive_regularized) {
        text << " (magic number " << choose_magic_number(config) << ", odd rate "
             << odd_rate(config) << ")";
    }
    text << ": ";
    if (config.collision != Collision::automatic) {
        text << "asked for";
    } else if (reaches_trt(tau)) {
        text
            << "relaxation time " << tau << " is at least " << fitted::trt_from
            << ", where two-relaxation-time collision is stable and has the lowest error";
    } else if (chosen == Collision::trt) {
        text << "relaxation time " << tau << " is below " << fitted::trt_from
             << ", and a wall moves: regularised collision fails where it meets a "
                "resting one";
    } else if (chosen == Collision::recursive_mrt) {
        text << "relaxation time " << tau << " is below " << fitted::trt_from
             << ", and the layers at bodies without slip do not depend on its time step";
    } else {
        text << "relaxation time " << tau << " is below " << fitted::trt_from
             << ", where it stays stable in flows that the grid does not resolve";
    }
    return text.str();
}

void check(const FluidConfig& config) {
    for (int axis = 0; axis < 3; ++axis) {
        // A row along x is walked in one piece and needs two cells. Across the rows,
        // along a periodic axis, a single cell can be its own neighbour.
        const int least = axis > 0 && periodic_axes(config)[axis] ? 1 : 2;
        if (config.cells[axis] < least) {
            refuse("fluid has ", config.cells[axis], " cells along ", axis_name[axis],
                   "; it needs at least ", least);
        }
    }
    const double tau = relaxation_time(config);
    if (!(tau > 0.5) || !std::isfinite(tau)) {
        refuse("fluid relaxation time 3 nu dt / dx^2 + 1/2 is ", tau, " with viscosity ",
               config.viscosity_m2_s,
               " m2/s; it must be above 0.5: use a positive viscosity and a longer time "
               "step or finer spacing");
    }
    check_sides(config);
    make_solids(config);
}

}  // namespace magfsi::fluid
