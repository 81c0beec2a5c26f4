// SPDX-License-Identifier: GPL-2.0-or-later
// A lattice-Boltzmann fluid's part of a checkpoint. Every population is stored by the
// global index of its cell, so that the file is the same on any number of ranks.
#pragma once

#include <mpi.h>

#include <string>

#include "coupler/checkpoint/state_file.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

// Writes the populations as a table [z][y][x][19], deviations from their rest values, in
// the precision in which the fluid stores them. Collective; file is null except on rank
// 0.
void save(MPI_Comm comm, const fluid::Fluid& fluid, const std::string& table,
          coupler::StateWriter* file);

// Number of the fluid's time steps in one coupled step of the stored state, whose step
// may be longer (a retry with halved steps); 0 if the ratio is no whole number.
std::int64_t steps_in_one(const fluid::Fluid& finest, const coupler::StateReader& file);

// Overwrites the populations of this rank's cells. The fluid's step must have been set
// (Fluid::set_steps_done). If steps_in_one is above 1, populations are rescaled to the
// shorter step (fluid_lbm/sampling/step_change.h). Throws coupler::StateFault if the
// table has another shape or cannot be read.
void restore(fluid::Fluid& fluid, const std::string& table, std::int64_t steps_in_one,
             const coupler::StateReader& file);

}  // namespace magfsi::lbm
