// A flow in a checkpoint: by cells and faces of the whole box, whoever holds them.
#pragma once

#include <mpi.h>

#include "adapters/openfoam/engine/engine.h"
#include "coupler/checkpoint/state_file.h"

namespace magfsi::openfoam {

// Collective; file is null but on the root.
void save_flow(MPI_Comm comm, const BoxMesh& mesh, const FlowState& state,
               coupler::StateWriter* file);

// This rank's part. Throws coupler::StateFault when the file is of another mesh.
FlowState load_flow(const BoxMesh& mesh, const coupler::StateReader& file);

}  // namespace magfsi::openfoam
