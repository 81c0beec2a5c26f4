// SPDX-License-Identifier: GPL-2.0-or-later
// The uniform magnetic field over time (eqs. 7 to 9).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "structure/options.h"

namespace magfsi::structure {

// Field vector at a time [T], the sum of all laws. A formula throws as value_at does.
Vec3 field_at(const FieldProgram& program, double time_s);

// Strength of the field at a time [T]: the signed magnitude if the program is a single
// law in the plane, else the length of the vector.
double field_magnitude_at(const FieldProgram& program, double time_s);

// A constant field with the vector that the program has at a time.
FieldProgram held_at(const FieldProgram& program, double time_s);

// Vector [T] of a field in a plane. Throws std::invalid_argument unless the plane has two
// different axes.
Vec3 field_vector(const ConstantField& field, const std::array<int, 2>& plane);

// The field program as arguments of fix magttice/field, and back:
//   xz constant MAGNITUDE DIRECTION
//   xz rotating MAGNITUDE START FREQUENCY
//   xz table|repeat  TIME MAGNITUDE DIRECTION  TIME MAGNITUDE DIRECTION ...
//   xz vector BX BY BZ
//   xz vectors|repeat_vectors  TIME BX BY BZ  TIME BX BY BZ ...
//   xz oscillating BX BY BZ FREQUENCY PHASE
//   xz precessing MAGNITUDE AXIS_X AXIS_Y AXIS_Z CONE FREQUENCY START RAMP
//   xz formula BX BY BZ       of t [s] in T, without blanks (structure/formula.h)
// The first word is the plane, which the last five laws do not use. The course follows,
// then further laws that are added to it, each after the word `plus`. Numbers are exact
// when read back. SI, angles in radians. Both functions throw std::invalid_argument on a
// program or words that are not valid.
std::string field_arguments(const FieldProgram& program);
FieldProgram parse_field_arguments(const std::vector<std::string>& words);

}  // namespace magfsi::structure
