// The fluid's half of a checkpoint: every population by its cell's global index, so that
// the file is the same on any number of ranks.
#pragma once

#include <mpi.h>

#include "coupler/checkpoint/state_file.h"
#include "coupler/immersed_boundary/balance.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

// Collective; file is null but on the root, balance where the scene has none.
void save_fluid(MPI_Comm comm, const fluid::Fluid& fluid,
                const coupler::BalanceRecord* balance, coupler::StateWriter* file);

// Every rank reads its own cells. Of a state with a longer step it makes one of the
// fluid's (fluid_lbm/sampling/step_change.h). Throws coupler::StateFault when the file is
// of another box.
void restore_fluid(MPI_Comm comm, const coupler::StateReader& file, fluid::Fluid& fluid,
                   coupler::BalanceRecord* balance);

}  // namespace magfsi::lbm
