// SPDX-License-Identifier: GPL-2.0-or-later
// Words of the motions that a body's faces and a source of the field can both have.
#pragma once

#include "structure/lammps/law_words.h"
#include "structure/options.h"

namespace magfsi::structure {

template <>
constexpr const char* law_name<Oscillation> = "oscillation";
template <>
constexpr const char* law_name<DisplacementRamp> = "ramp";
template <>
struct LawWords<FormulaMotion> : FormulaWords<FormulaMotion> {};

}  // namespace magfsi::structure
