// SPDX-License-Identifier: GPL-2.0-or-later
// Exchange of density, velocity and stress between neighbouring levels: by cubic
// interpolation from the coarse to the fine level; back by cubic interpolation for
// density and velocity and by the mean of eight cells for the stress. Interpolation of
// lower order, or a stress that is not rescaled, gives visible errors (Lagrava et al.
// 2012; docs/refinement.md has the figures).
//
// Velocity and density are the same on both sides. With half the step on half the
// spacing,
//   tau_f - 1/2 = 2 (tau_c - 1/2),   stress_f = stress_c tau_f / (2 tau_c),
// and the same for the trace of the stress with its own relaxation times, if it has them.
#pragma once

#include <array>

#include "fluid_lbm/refinement/level.h"

namespace magfsi::fluid {

// Density - 1, velocity and stress of a cell (flow_kernel.h).
constexpr std::size_t numbers_between_levels = flow_numbers;

// Points of a cubic along one axis.
constexpr int cubic_points = 4;

// Weights of cubic_points neighbouring cells, from cell `first` on.
struct Weights {
    int first = 0;
    std::array<double, cubic_points> of{};
};
// Weights of Lagrange's cubic at a point, with centres of cells at whole numbers; the
// cells read lie in [lo, hi).
Weights cubic_at(double at, int lo, int hi);

// Scales from the coarse level's numbers to the fine one's. Both velocities lack half of
// their step's body force, and the finer level's half is smaller: velocity is the
// difference.
struct Scales {
    double stress = 1;
    double trace = 1;  // of the stress: factor beside `stress`
    Vec3 velocity{};
};
// The scales between a level and the next finer one.
Scales to_fine(const Level& coarse, const Level& fine);
// Applies the scales to `flow`, ten arrays of `count` values one after the other. sign: 1
// from the coarse to the fine level, -1 back.
void apply(const Scales& scales, double sign, double* flow, std::size_t count);
// Multiplies the trace of the stress by a factor; the rest of the stress stays. stress:
// six arrays of `count` values, the diagonal first.
void scale_trace(double factor, double* stress, std::size_t count);

}  // namespace magfsi::fluid
