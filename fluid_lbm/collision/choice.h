// Which collision a configuration runs with, and why.
#pragma once

#include <string>

#include "fluid_lbm/fluid.h"

namespace magfsi::fluid {

// config.collision, or for automatic the choice by relaxation time.
Collision choose_collision(const FluidConfig& config);
// config.magic_number, or the one for this relaxation time.
double choose_magic_number(const FluidConfig& config);
// Rate at which two-relaxation-time collision lets odd modes decay with it.
double odd_rate(const FluidConfig& config);

}  // namespace magfsi::fluid
