// SPDX-License-Identifier: GPL-2.0-or-later
// A world of its own for OpenFOAM, which in parallel uses MPI_COMM_WORLD, to which the
// structure's ranks belong, too. This program defines MPI functions (by the MPI profiling
// interface, PMPI) that replace the communicator.
#pragma once

#include <mpi.h>

namespace magfsi::openfoam {

// Makes `comm` the communicator that MPI_COMM_WORLD stands for in the wrapped functions.
// MPI_Abort still ends the whole job. After this call no other code of this process can
// reach the true world through them.
void set_world(MPI_Comm comm);

}  // namespace magfsi::openfoam
