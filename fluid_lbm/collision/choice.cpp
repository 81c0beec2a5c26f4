#include "fluid_lbm/collision/choice.h"

#include <algorithm>
#include <sstream>

#include "fluid_lbm/collision/registered.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

namespace {

// Two-relaxation-time collision had the lowest error of the three at moderate relaxation
// times. Near 1/2 its odd rate vanishes if Lambda stays at 3/16 (0.24 at 0.55, 0.018 at
// 0.5035, 0.008 at 0.5015): a swimming robot and a Taylor-Green vortex diverged.
constexpr double trt_from = 0.55;

bool has_moving_wall(const FluidConfig& config) {
    return std::ranges::any_of(config.boundaries, [](const Boundary& side) {
        return side.kind == BoundaryKind::no_slip && side.wall_velocity_m_s != Vec3{};
    });
}

}  // namespace

double choose_magic_number(const FluidConfig& config) {
    if (config.magic_number) return *config.magic_number;
    const double tau = relaxation_time(config);
    // 3/16 puts half-way walls exactly half way; (tau - 1/2) / 2 makes the odd rate 1.
    return tau >= trt_from ? 3.0 / 16 : (tau - 0.5) / 2;
}

double odd_rate(const FluidConfig& config) {
    return odd_rate(1 / relaxation_time(config), choose_magic_number(config));
}

// Recursive regularisation is the one that survives unresolved turbulence (Taylor-Green
// at Reynolds number 100,000 on 32^3 cells). But where a moving wall meets a resting one
// it diverged or lost its way (cavity at Reynolds number 1000 on 64^2 cells, relaxation
// time 0.519), which two relaxation times with an odd rate of 1 do not.
Collision choose_collision(const FluidConfig& config) {
    if (config.collision != Collision::automatic) return config.collision;
    const bool low = relaxation_time(config) < trt_from;
    return low && !has_moving_wall(config) ? Collision::recursive_regularized
                                           : Collision::trt;
}

std::string collision_reason(const FluidConfig& config) {
    const double tau = relaxation_time(config);
    const Collision chosen = choose_collision(config);
    std::ostringstream text;
    text.precision(4);
    text << name_of(chosen);
    if (chosen == Collision::trt) {
        text << " (magic number " << choose_magic_number(config) << ", odd rate "
             << odd_rate(config) << ")";
    }
    text << ": ";
    if (config.collision != Collision::automatic) {
        text << "asked for";
    } else if (tau >= trt_from) {
        text << "relaxation time " << tau << " is at least " << trt_from
             << ", where two-relaxation-time collision is stable and has the lowest "
                "error";
    } else if (chosen == Collision::trt) {
        text << "relaxation time " << tau << " is below " << trt_from
             << ", and a wall moves: regularised collision fails where it meets a "
                "resting one";
    } else {
        text << "relaxation time " << tau << " is below " << trt_from
             << ", where it stays stable in flows that the grid does not resolve";
    }
    return text.str();
}

}  // namespace magfsi::fluid
