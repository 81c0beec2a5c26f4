#include "fluid_lbm/config.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/obstacle/solid.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// Of recursive_mrt. Small ones damp more: at 3/16 the swimmer diverges at a relaxation
// time of 0.5015, at 0.02 with the 3-point kernel (docs/coupling_measurements.md).
constexpr double recursive_magic = 0.01;

bool has_moving_wall(const FluidConfig& config) {
    return std::ranges::any_of(config.boundaries, [](const Boundary& side) {
        return side.kind == BoundaryKind::no_slip && side.wall_velocity_m_s != Vec3{};
    });
}

}  // namespace

Units units(const FluidConfig& config) {
    return {config.spacing_m, config.time_step_s, config.density_kg_m3};
}

double relaxation_time(const FluidConfig& config) {
    return relaxation_time(config.viscosity_m2_s, config.time_step_s, config.spacing_m);
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

double choose_magic_number(const FluidConfig& config) {
    if (config.magic_number) return *config.magic_number;
    if (choose_collision(config) == Collision::recursive_mrt) return recursive_magic;
    const double tau = relaxation_time(config);
    // 3/16 puts half-way walls exactly half way; (tau - 1/2) / 2 makes the odd rate 1.
    return tau >= trt_from ? 3.0 / 16 : (tau - 0.5) / 2;
}

double odd_rate(const FluidConfig& config) {
    return odd_rate(1 / relaxation_time(config), choose_magic_number(config));
}

// Two-relaxation-time collision had the lowest error of the three at moderate relaxation
// times. Recursive regularisation is the one that survives unresolved turbulence
// (Taylor-Green at Reynolds number 100,000 on 32^3 cells). But where a moving wall meets
// a resting one it diverged or lost its way (cavity at Reynolds number 1000 on 64^2
// cells, relaxation time 0.519), which two relaxation times with an odd rate of 1 do not.
Collision choose_collision(const FluidConfig& config) {
    if (config.collision != Collision::automatic) return config.collision;
    const bool low = relaxation_time(config) < trt_from;
    if (!low || has_moving_wall(config)) return Collision::trt;
    return config.holds_no_slip ? Collision::recursive_mrt
                                : Collision::recursive_regularized;
}

std::string collision_reason(const FluidConfig& config) {
    const double tau = relaxation_time(config);
    const Collision chosen = choose_collision(config);
    std::ostringstream text;
    text.precision(4);
    text << name_of(chosen);
    if (chosen == Collision::trt || chosen == Collision::recursive_mrt) {
        text << " (magic number " << choose_magic_number(config) << ", odd rate "
             << odd_rate(config) << ")";
    }
    text << ": ";
    if (config.collision != Collision::automatic) {
        text << "asked for";
    } else if (tau >= trt_from) {
        text
            << "relaxation time " << tau << " is at least " << trt_from
            << ", where two-relaxation-time collision is stable and has the lowest error";
    } else if (chosen == Collision::trt) {
        text << "relaxation time " << tau << " is below " << trt_from
             << ", and a wall moves: regularised collision fails where it meets a "
                "resting one";
    } else if (chosen == Collision::recursive_mrt) {
        text << "relaxation time " << tau << " is below " << trt_from
             << ", and the layers at bodies without slip do not depend on its time step";
    } else {
        text << "relaxation time " << tau << " is below " << trt_from
             << ", where it stays stable in flows that the grid does not resolve";
    }
    return text.str();
}

void check(const FluidConfig& config) {
    for (int axis = 0; axis < 3; ++axis) {
        // Rows along x are walked in one piece; across them one cell is its own
        // neighbour.
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
