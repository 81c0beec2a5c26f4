// SPDX-License-Identifier: GPL-2.0-or-later
// A lattice-Boltzmann fluid's part of a checkpoint: every population by its cell's global
// index, so that the file is the same on any number of ranks.
#pragma once

#include <mpi.h>

#include <string>

#include "coupler/checkpoint/state_file.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

// Collective; file is null but on the root.
void save(MPI_Comm comm, const fluid::Fluid& fluid, const std::string& table,
          coupler::StateWriter* file);

// Steps of the fluid in one of the state's, which may be longer.
std::int64_t steps_in_one(const fluid::Fluid& finest, const coupler::StateReader& file);

// After Fluid::set_steps_done. Throws coupler::StateFault.
void restore(fluid::Fluid& fluid, const std::string& table, std::int64_t steps_in_one,
             const coupler::StateReader& file);

}  // namespace magfsi::lbm
