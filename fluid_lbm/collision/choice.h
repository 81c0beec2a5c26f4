// SPDX-License-Identifier: GPL-2.0-or-later
// Which collision runs and with which magic number, where options leave it open.
#pragma once

#include <algorithm>

#include "fluid_lbm/options.h"
#include "fluid_lbm/rheology.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

// What the automatic choice depends on besides options.
struct CollisionCase {
    double relaxation_time = 1;
    // Bodies hold the fluid without slip: their layers shall not depend on the time step.
    bool holds_no_slip = false;
    double cell_reynolds_number = 0;  // of recursive_odd and recursive_mrt only
};

// Largest expected speed times spacing over viscosity; where that speed is not given (0),
// of the usual 0.05 spacings a step. A fluid that thins has the viscosity that it has
// where that speed changes over one spacing.
inline double cell_reynolds_number(const Options& options, double expected_speed_m_s,
                                   double spacing_m, double relaxation_time) {
    constexpr double usual_lattice_speed = 0.05;
    const double speed = expected_speed_m_s;
    if (!(speed > 0)) return 3 * usual_lattice_speed / (relaxation_time - 0.5);
    double least_m2_s = options.viscosity_m2_s;
    if (options.rheology)
        least_m2_s = std::min(
            least_m2_s, viscosity_m2_s(*options.rheology, least_m2_s, speed / spacing_m));
    return speed * spacing_m / least_m2_s;
}

// Of recursive_mrt: large on grids that resolve the flow, for walls stand where they
// should with 3/16; small on others, where odd modes must decay. The swimmer has a cell
// Reynolds number of 100 at 0.2 mm: there 0.0075 runs for three periods, 0.01 for two and
// 0.05 for a fifth of one. From 60 on it falls with the square, to keep well below that.
// It does not depend on the time step.
constexpr double recursive_magic(double cell_reynolds_number) {
    const double steep = std::max(1.0, cell_reynolds_number / 60);
    return std::clamp(0.75 / (cell_reynolds_number * steep), 0.001, 3.0 / 16);
}

// Of recursive_odd: what puts half-way walls exactly half way (recursive_regularized.h),
// up to a cell Reynolds number of 60. From there on it falls with the square (a ball of 8
// cells diverges at 250 with 3/16, not with 0.05), to what drops these modes too.
constexpr double recursive_odd_magic(double cell_reynolds_number, double slack) {
    const double coarse = std::max(1.0, cell_reynolds_number / 60);
    return std::max(slack / 2, (0.25 - slack / 6) / (coarse * coarse));
}

// Of recursive_odd, too: how much of what walls of obstacles return is that of a curved
// profile (obstacle/wall_return.h), the rest of a straight one. It falls as the number
// does.
constexpr double curved_wall_share(double cell_reynolds_number) {
    const double coarse = std::max(1.0, cell_reynolds_number / 60);
    return 1 / (coarse * coarse);
}

// To six digits: a viscosity that is written down for 0.55 shall not fall on either side.
constexpr bool reaches_trt(double relaxation_time) {
    return relaxation_time > trt_from - 1e-6;
}

inline bool has_moving_wall(const Options& options) {
    return std::ranges::any_of(options.boundaries, [](const Boundary& side) {
        return side.kind == BoundaryKind::no_slip && side.wall_velocity_m_s != Vec3{};
    });
}

// Two-relaxation-time collision had the lowest error of the three at moderate relaxation
// times. Recursive regularisation is the one that survives unresolved turbulence
// (Taylor-Green at Reynolds number 100,000 on 32^3 cells). But where a moving wall meets
// a resting one it diverged or lost its way (cavity at Reynolds number 1000 on 64^2
// cells, relaxation time 0.519), which two relaxation times with an odd rate of 1 do not.
// At obstacles it is half as accurate as recursive_odd, and that survives as much.
inline Collision choose_collision(const Options& options, const CollisionCase& now) {
    if (options.collision != Collision::automatic) return options.collision;
    const bool low = !reaches_trt(now.relaxation_time);
    if (!low || has_moving_wall(options)) return Collision::trt;
    if (now.holds_no_slip) return Collision::recursive_mrt;
    const bool walls = !options.obstacles.empty() && options.smagorinsky_constant == 0;
    return walls ? Collision::recursive_odd : Collision::recursive_regularized;
}

inline double choose_magic_number(const Options& options, const CollisionCase& now) {
    if (options.magic_number) return *options.magic_number;
    const Collision chosen = choose_collision(options, now);
    if (chosen == Collision::recursive_mrt)
        return recursive_magic(now.cell_reynolds_number);
    if (chosen == Collision::recursive_odd)
        return recursive_odd_magic(now.cell_reynolds_number, now.relaxation_time - 0.5);
    // 3/16 puts half-way walls exactly half way; (tau - 1/2) / 2 makes the odd rate 1.
    return reaches_trt(now.relaxation_time) ? 3.0 / 16 : (now.relaxation_time - 0.5) / 2;
}

}  // namespace magfsi::fluid
