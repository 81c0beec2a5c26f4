// SPDX-License-Identifier: GPL-2.0-or-later
// Configuration of a fluid solver in SI, and the quantities that the solver derives from
// it.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "base/grid/cells.h"
#include "fluid_lbm/options.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

using magfsi::CellBox;

// The options of the user, and the grid, the time step and the initial flow that the
// caller derives from the scene. check() tells if a configuration can run.
struct FluidConfig : Options {
    std::array<int, 3> cells{};  // number of cells along x, y, z
    double spacing_m = 0;        // edge of a cell [m]
    double time_step_s = 0;      // time step [s]
    // Initial velocity [m/s] and gauge pressure [Pa] at a point [m]; an empty function
    // stands for fluid at rest. Asked for points inside the box and on its sides.
    std::function<Vec3(const Vec3&)> initial_velocity;
    std::function<double(const Vec3&)> initial_pressure;
    // True if immersed bodies hold the fluid without slip. The automatic choice then
    // takes a collision whose boundary layer at a body does not depend on the time step.
    bool holds_no_slip = false;
    double expected_speed_m_s = 0;  // largest expected speed [m/s]; 0: not known
    // False if plane_flow() is never called: what obstacles add to it is not prepared.
    bool measures_planes = true;
    // True for a patch of a refined grid: its obstacles may lie outside its box.
    bool is_patch = false;
    // For a patch: length of the whole domain along each periodic axis, in cells of the
    // patch; 0 along axes that are not periodic.
    std::array<int, 3> box_period{};
    // Sides (order of Options::boundaries) whose two outer layers of cells the caller
    // fills before every even step (0, 2, ...), as a patch's ring. The odd steps then
    // leave out the outermost layer, because its result is overwritten.
    std::array<bool, 6> refilled{};
};

// Factors between SI and the lattice units of this configuration.
Units units(const FluidConfig& config);
// Relaxation time tau of the constant viscosity, in steps.
double relaxation_time(const FluidConfig& config);
// Relaxation time of the trace of the stress, in steps; absent without a bulk viscosity.
std::optional<double> trace_relaxation_time(const FluidConfig& config);
// True for each axis that is periodic. Only the low side is asked: sides of a periodic
// axis come in pairs.
std::array<bool, 3> periodic_axes(const FluidConfig& config);
// True if collision and streaming alone change the populations in a step: all sides are
// periodic or resting walls, and there is neither an obstacle nor a body force.
bool sweep_is_all(const FluidConfig& config);
// Velocity of the wall at a side, in cells per step.
Vec3 wall_velocity(const FluidConfig& config, int side);
// Half of the body force on a cell in lattice units. The sum of c f lacks this much of
// the momentum between two steps (Guo, Zheng, Shi 2002).
Vec3 half_body_force(const FluidConfig& config);

// The collision that runs: config.collision, or, where that is automatic, the choice of
// collision/choice.h.
Collision choose_collision(const FluidConfig& config);
// The collision and the reason for it, as one line for a log.
std::string collision_reason(const FluidConfig& config);
// The magic number Lambda that runs: config.magic_number if it is given, else the one of
// collision/choice.h.
double choose_magic_number(const FluidConfig& config);
// Relaxation rate of the odd populations (odd third-order modes in recursive_mrt) that
// follows from the magic number and the viscosity.
double odd_rate(const FluidConfig& config);

// Throws std::invalid_argument with a sentence on the first value that cannot run. Values
// that the reader of the scene has checked already, with their lines in the file, are not
// checked again.
void check(const FluidConfig& config);

}  // namespace magfsi::fluid
