// Inner products of vectors that are spread over ranks. The same bits on every rank, so
// that all decide alike.
#pragma once

#include <mpi.h>

#include <span>

namespace magfsi::coupler {

// Collective; each rank gives its part.
double inner_product(MPI_Comm comm, std::span<const double> a, std::span<const double> b);

// Euclidean.
double norm(MPI_Comm comm, std::span<const double> a);

}  // namespace magfsi::coupler
