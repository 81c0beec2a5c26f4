// SPDX-License-Identifier: GPL-2.0-or-later
// Which row kernels a run uses: instruction set, precision, collision.
#pragma once

#include <variant>

#include "fluid_lbm/config.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/streaming/kernels.h"
#include "isa/instruction_set.h"

namespace magfsi::fluid {

inline Storage storage_of(Precision precision) {
    return precision == Precision::double_ ? Storage::double_ : Storage::float_;
}

// By what populations are stored as.
using AnyKernels = std::variant<RowKernels<double>, RowKernels<float>>;

// collision: not automatic.
AnyKernels choose_kernels(InstructionSet set, Precision precision, Collision collision,
                          LocalViscosity viscosity);

}  // namespace magfsi::fluid
