// SPDX-License-Identifier: GPL-2.0-or-later
// Formulas of the time t, evaluated by muParser (https://beltoforion.de/en/muparser).
#pragma once

#include <array>
#include <string>

#include "base/vector/vec3.h"

namespace magfsi::structure {

// A formula of the time t [s]. written: the text of the scene, with units. si: the same
// in numbers of SI, one word without blanks; it is the one that is evaluated.
struct Formula {
    std::string written{"0"}, si{"0"};
};

// Value of the formula `si` at a time, in the SI unit of its quantity. Throws
// std::runtime_error, with formula and time, if the value is NaN or infinite, and
// std::invalid_argument if the text is no formula. Each thread compiles a text at its
// first use and keeps it.
double value_at(const std::string& si, double time_s);

// The same for three formulas, the components along x, y and z.
Vec3 value_at(const std::array<Formula, 3>& component, double time_s);

// Displacement [m] from the place at time 0, velocity [m/s] and acceleration [m/s2] of a
// point whose place is given by formulas. The derivatives are finite differences.
Vec3 displacement(const std::array<Formula, 3>& place_m, double time_s);
Vec3 velocity(const std::array<Formula, 3>& place_m, double time_s);
Vec3 acceleration(const std::array<Formula, 3>& place_m, double time_s);

// value_at for one formula, except that NaN and infinity are returned instead of thrown.
double value_or_nan(const std::string& si, double time_s);

// Name of a value that is not finite: "not a number" or "infinite".
const char* fault_of(double value);

}  // namespace magfsi::structure
