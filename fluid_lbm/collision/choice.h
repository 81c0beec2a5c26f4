// SPDX-License-Identifier: GPL-2.0-or-later
// Choice of the collision and of its magic number where the options leave it open.
#pragma once

#include <algorithm>

#include "base/fitted/constants.h"
#include "fluid_lbm/options.h"
#include "fluid_lbm/rheology.h"

namespace magfsi::fluid {

// Quantities beside the options on which the automatic choice depends.
struct CollisionCase {
    double relaxation_time = 1;  // tau in steps
    // True if immersed bodies hold the fluid without slip: their boundary layers shall
    // not depend on the time step.
    bool holds_no_slip = false;
    double cell_reynolds_number = 0;  // used where holds_no_slip is true
    // True if a side is a wall that moves along itself, with inertia in a cell beside it.
    bool has_moving_wall = false;
};

// Reynolds number of a cell: largest expected speed times spacing over viscosity. If no
// speed is given (0), it is 0.05 spacings per step, which is usual. A shear-thinning
// fluid enters with its viscosity at the rate speed / spacing.
inline double cell_reynolds_number(const Options& options, double expected_speed_m_s,
                                   double spacing_m, double relaxation_time) {
    const double speed = expected_speed_m_s;
    if (!(speed > 0)) return 3 * fitted::usual_lattice_speed / (relaxation_time - 0.5);
    double least_m2_s = options.viscosity_m2_s;
    if (options.rheology)
        least_m2_s = std::min(
            least_m2_s, viscosity_m2_s(*options.rheology, least_m2_s, speed / spacing_m));
    return speed * spacing_m / least_m2_s;
}

// Magic number of recursive_mrt around bodies without slip. It is large on grids that
// resolve the flow, where 3/16 puts walls in their place, and small on coarse ones, where
// odd modes must decay; from a Reynolds number of 60 on it falls with the square. It does
// not depend on the time step if the expected speed is given.
constexpr double recursive_magic(double cell_reynolds_number) {
    using namespace fitted;
    const double steep = std::max(1.0, cell_reynolds_number / steep_from_reynolds);
    return std::clamp(magic_times_reynolds / (cell_reynolds_number * steep),
                      least_magic_number, 3.0 / 16);
}

// True from the relaxation time at which trt is chosen, to six digits: rounding must not
// decide for a viscosity that was chosen to give exactly 0.55.
constexpr bool reaches_trt(double relaxation_time) {
    return relaxation_time > fitted::trt_from - 1e-6;
}

// True if a side is a wall that moves along itself. One that is so slow that a cell
// beside it has no inertia (Reynolds number of the cell below 0.01; the regularised
// collision fails from about 10 on) counts as resting: what hardly moves shall change
// nothing.
inline bool has_moving_wall(const Options& options, double spacing_m,
                            double relaxation_time) {
    return std::ranges::any_of(options.boundaries, [&](const Boundary& side) {
        const double speed_m_s = norm(side.wall_velocity_m_s);
        return side.kind == BoundaryKind::no_slip && speed_m_s > 0 &&
               cell_reynolds_number(options, speed_m_s, spacing_m, relaxation_time) >
                   0.01;
    });
}

// The collision that runs. Two relaxation times had the lowest error of the three at
// moderate relaxation times. Recursive regularisation survives unresolved turbulence
// (Taylor-Green at Reynolds number 100,000 on 32^3 cells). Where a moving wall meets a
// resting one, however, it diverged or gave a wrong flow (cavity at Reynolds number 1000
// on 64^2 cells, relaxation time 0.519), which two relaxation times with an odd rate of 1
// do not. Additions to the fluid (obstacles, rheology, eddies) do not change the choice.
inline Collision choose_collision(const Options& options, const CollisionCase& now) {
    if (options.collision != Collision::automatic) return options.collision;
    const bool low = !reaches_trt(now.relaxation_time);
    if (!low || now.has_moving_wall) return Collision::trt;
    if (now.holds_no_slip) return Collision::recursive_mrt;
    return Collision::recursive_regularized;
}

// The magic number that runs: that of the options if it is given.
inline double choose_magic_number(const Options& options, const CollisionCase& now) {
    if (options.magic_number) return *options.magic_number;
    if (now.holds_no_slip && choose_collision(options, now) == Collision::recursive_mrt)
        return recursive_magic(now.cell_reynolds_number);
    // 3/16 puts half-way walls exactly half way; (tau - 1/2) / 2 makes the odd rate 1.
    return reaches_trt(now.relaxation_time) ? 3.0 / 16 : (now.relaxation_time - 0.5) / 2;
}

}  // namespace magfsi::fluid
