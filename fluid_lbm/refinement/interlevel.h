// SPDX-License-Identifier: GPL-2.0-or-later
// What two neighbouring levels tell each other, as density, velocity and stress: cubic
// interpolation from the coarse to the fine one, and back by four points along each axis
// for density and velocity, by the mean of eight cells for the stress. Anything of lower
// order, and a stress that is not rescaled, shows (Lagrava et al. 2012, J. Comput. Phys.
// 231; docs/refinement.md has the figures).
//
// With velocity and density alike on both sides and half the step on half the spacing,
//   tau_f - 1/2 = 2 (tau_c - 1/2),   stress_f = stress_c tau_f / (2 tau_c).
#pragma once

#include <array>

#include "fluid_lbm/refinement/level.h"

namespace magfsi::fluid {

constexpr std::size_t numbers_between_levels = flow_numbers;

constexpr int cubic_points = 4;

// Neighbouring cells and what each counts.
struct Weights {
    int first = 0;
    std::array<double, cubic_points> of{};
};
// Lagrange's cubic at a point, through cells first, first + 1, ... which lie in [lo, hi).
Weights cubic_at(double at, int lo, int hi);

// From the coarse level's numbers to the fine one's; both have the velocity before half
// of the step's body force, of which the finer one's is half as large.
struct Scales {
    double stress = 1;
    Vec3 velocity{};
};
Scales to_fine(const Level& coarse, const Level& fine);
// sign: 1 to the fine level, -1 back.
void apply(const Scales& scales, double sign, double* flow, std::size_t count);

}  // namespace magfsi::fluid
