// SPDX-License-Identifier: GPL-2.0-or-later
// Choice of the row kernels of a run by instruction set, precision and collision.
#pragma once

#include <variant>

#include "base/isa/instruction_set.h"
#include "fluid_lbm/config.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/streaming/kernels.h"

namespace magfsi::fluid {

// Row kernels for either type of stored populations.
using AnyKernels = std::variant<RowKernels<double>, RowKernels<float>>;

// The kernels of a collision, which must not be automatic. Throws std::invalid_argument
// if no kernel is registered for it.
AnyKernels choose_kernels(InstructionSet set, Precision precision, Collision collision,
                          LocalViscosity viscosity, TraceRate trace = TraceRate::viscous);

}  // namespace magfsi::fluid
