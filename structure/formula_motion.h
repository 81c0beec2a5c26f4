// SPDX-License-Identifier: GPL-2.0-or-later
// Motions by formulas.
#pragma once

#include "structure/options.h"

namespace magfsi::structure {

// From the place at time 0 [m]; its first and second derivative by time [m/s, m/s2]. All
// throw std::runtime_error where a formula has no value.
Vec3 displacement(const FormulaMotion& motion, double time_s);
Vec3 velocity(const FormulaMotion& motion, double time_s);
Vec3 acceleration(const FormulaMotion& motion, double time_s);

}  // namespace magfsi::structure
