// SPDX-License-Identifier: GPL-2.0-or-later
// The uniform magnetic field over time (eqs. 7 to 9). A new course needs its struct in
// structure/options.h and its part in field_program.cpp: docs/adding_a_field_law.md.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "structure/options.h"

namespace magfsi::structure {

// Field vector [T].
Vec3 field_at(const FieldProgram& program, double time_s);

// Of one law in the plane its magnitude, with its sign; else the length of the vector.
double field_magnitude_at(const FieldProgram& program, double time_s);

// Its vector at a time, for ever.
FieldProgram held_at(const FieldProgram& program, double time_s);

Vec3 field_vector(const ConstantField& field, const std::array<int, 2>& plane);

// The arguments of fix magttice/field, and back:
//   xz constant MAGNITUDE DIRECTION
//   xz rotating MAGNITUDE START FREQUENCY
//   xz table|repeat  TIME MAGNITUDE DIRECTION  TIME MAGNITUDE DIRECTION ...
//   xz vector BX BY BZ
//   xz vectors|repeat_vectors  TIME BX BY BZ  TIME BX BY BZ ...
//   xz oscillating BX BY BZ FREQUENCY PHASE
//   xz precessing MAGNITUDE AXIS_X AXIS_Y AXIS_Z CONE FREQUENCY START RAMP
//   xz formula BX BY BZ       of t [s] in T, without spaces (structure/formula.h)
// The words are the two axes of the plane, which the last five laws do not use, and the
// course; further laws that add to it follow, each after the word `plus`. Numbers read
// back exactly. Both throw std::invalid_argument on what is not such a program.
std::string field_arguments(const FieldProgram& program);
FieldProgram parse_field_arguments(const std::vector<std::string>& words);

}  // namespace magfsi::structure
