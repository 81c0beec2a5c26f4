// SPDX-License-Identifier: GPL-2.0-or-later
// What users of the fluid say, in SI, and what follows from it.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "fluid_lbm/options.h"
#include "fluid_lbm/units.h"
#include "grid/cells.h"

namespace magfsi::fluid {

using magfsi::CellBox;

struct FluidConfig : Options {
    std::array<int, 3> cells{};
    double spacing_m = 0;
    double time_step_s = 0;
    // Velocity [m/s] and gauge pressure [Pa] at a cell centre [m]; absent: rest.
    std::function<Vec3(const Vec3&)> initial_velocity;
    std::function<double(const Vec3&)> initial_pressure;
    // Bodies hold the fluid without slip: the automatic collision is one whose layers at
    // them do not depend on the time step.
    bool holds_no_slip = false;
    double expected_speed_m_s = 0;  // largest; 0: not known
    // A patch of a refined grid: obstacles may lie beyond it.
    bool is_patch = false;
    // Of a patch: cells of its size that the whole box has along periodic axes, else 0.
    std::array<int, 3> box_period{};
    // Sides whose two layers of cells somebody fills anew before every second step, the
    // even ones: what the outer layer does in the others is needed by nobody.
    std::array<bool, 6> refilled{};
};

Units units(const FluidConfig& config);
double relaxation_time(const FluidConfig& config);
// A periodic axis is so at both sides.
std::array<bool, 3> periodic_axes(const FluidConfig& config);
// Whether nothing but collision and streaming changes populations in a step.
bool sweep_is_all(const FluidConfig& config);
// Of a side's wall, lattice units.
Vec3 wall_velocity(const FluidConfig& config, int side);
// What momentum lacks between steps in each cell (Guo, Zheng, Shi 2002), lattice units.
Vec3 half_body_force(const FluidConfig& config);

// config.collision, or for automatic the choice by relaxation time.
Collision choose_collision(const FluidConfig& config);
// Why: one line for a log.
std::string collision_reason(const FluidConfig& config);
// config.magic_number, or the one for this relaxation time.
double choose_magic_number(const FluidConfig& config);
// Rate at which two-relaxation-time collision lets odd modes decay with it.
double odd_rate(const FluidConfig& config);

// Throws std::invalid_argument with a sentence on the first value that cannot run. What
// the scene checks with its lines is not checked again.
void check(const FluidConfig& config);

}  // namespace magfsi::fluid
