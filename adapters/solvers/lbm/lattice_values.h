// SPDX-License-Identifier: GPL-2.0-or-later
// The scene's fluid in SI and lattice units side by side, for `magfsi explain`, and
// warnings about values that make it inaccurate or unstable.
#pragma once

#include <string>

#include "adapters/scene/scene.h"
#include "fluid_lbm/config.h"

namespace magfsi::lbm {

// Values of a scene's fluid on the lattice. tau, mach, grid_reynolds and speed are in
// lattice units; those that need the expected speed are 0 without one. grid_reynolds is
// the expected speed times the spacing over the viscosity.
struct LatticeValues {
    double spacing_m, step_s, tau, mach = 0, grid_reynolds = 0, speed = 0;
    // Relaxation rate of the odd modes; 1 unless the collision is trt.
    double odd_rate = 1;
    // Largest shear rate that a cell resolves, the expected speed over the spacing, and
    // the viscosity at that rate [m2/s].
    double quickest_1_s = 0, quickest_m2_s = 0;
};

// config must be that of the scene's fluid (to_config).
LatticeValues lattice_values(const scene::Fluid& fluid, const fluid::FluidConfig& config);

// A table with a row for each quantity: name, SI value, lattice value.
std::string table(const scene::Fluid& fluid, const LatticeValues& v);

// A line for each value that should be changed: what is wrong and which value to take.
// Empty if all is well.
std::string warnings(const scene::Scene& scene, const LatticeValues& v);

// A line on the life of sound: the time in which it crosses the box, along the axis where
// it lives longest, and that in which a standing wave decays; if this is long, the bulk
// viscosity that damps it. Empty if each axis has an outlet, which lets sound out.
std::string life_of_sound(const scene::Fluid& fluid, const LatticeValues& v);

// A line for each velocity inlet: the time that sound takes to cross the box and (omega
// L / c)^2 of the inlet's variation in time and of its ramp, or the change of a course by
// table or formula meanwhile, until the run's end. The lattice behaves as an
// incompressible fluid only where this number is small (docs/howto/obstacle.md).
std::string sound(const scene::Fluid& fluid, const LatticeValues& v, double end_s);

}  // namespace magfsi::lbm
