// SPDX-License-Identifier: GPL-2.0-or-later
// OpenFOAM in parallel takes MPI_COMM_WORLD for itself, where the structure is, too. This
// program's own MPI functions (the MPI profiling interface) give it another world.
#pragma once

#include <mpi.h>

namespace magfsi::openfoam {

// From now on MPI_COMM_WORLD stands for comm in all that OpenFOAM calls; MPI_Abort still
// ends the whole job. Nothing else of this process may mean the world any more.
void set_world(MPI_Comm comm);

}  // namespace magfsi::openfoam
