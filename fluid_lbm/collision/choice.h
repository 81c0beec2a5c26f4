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
    double cell_reynolds_number = 0;  // of recursive_mrt only
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
// What only adds to the fluid (obstacles, rheology, eddies) does not change the choice.
inline Collision choose_collision(const Options& options, const CollisionCase& now) {
    if (options.collision != Collision::automatic) return options.collision;
    const bool low = !reaches_trt(now.relaxation_time);
    if (!low || has_moving_wall(options)) return Collision::trt;
    if (now.holds_no_slip) return Collision::recursive_mrt;
    return Collision::recursive_regularized;
}

inline double choose_magic_number(const Options& options, const CollisionCase& now) {
    if (options.magic_number) return *options.magic_number;
    const Collision chosen = choose_collision(options, now);
    if (chosen == Collision::recursive_mrt)
        return recursive_magic(now.cell_reynolds_number);
    // 3/16 puts half-way walls exactly half way; (tau - 1/2) / 2 makes the odd rate 1.
    return reaches_trt(now.relaxation_time) ? 3.0 / 16 : (now.relaxation_time - 0.5) / 2;
}

}  // namespace magfsi::fluid
