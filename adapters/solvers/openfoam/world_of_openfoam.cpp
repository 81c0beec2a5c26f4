// SPDX-License-Identifier: GPL-2.0-or-later
// Wrappers of the 15 MPI functions that OpenFOAM's libPstream calls with a communicator.
#include "adapters/solvers/openfoam/world_of_openfoam.h"

namespace {

// Communicator that stands for MPI_COMM_WORLD; MPI_COMM_NULL until set_world() is called.
MPI_Comm world = MPI_COMM_NULL;

// Replaces MPI_COMM_WORLD by the world that was set; leaves all other communicators
// alone.
MPI_Comm w(MPI_Comm comm) {
    return comm == MPI_COMM_WORLD && world != MPI_COMM_NULL ? world : comm;
}

}  // namespace

namespace magfsi::openfoam {

void set_world(MPI_Comm comm) {
    world = comm;
}

}  // namespace magfsi::openfoam

extern "C" {

// These definitions take precedence over the MPI library's. Each calls the library's
// function under its profiling name (PMPI_...) with the communicator replaced; collective
// or blocking behaviour stays the same.
int MPI_Comm_size(MPI_Comm c, int* n) {
    return PMPI_Comm_size(w(c), n);
}
int MPI_Comm_rank(MPI_Comm c, int* r) {
    return PMPI_Comm_rank(w(c), r);
}
int MPI_Comm_group(MPI_Comm c, MPI_Group* g) {
    return PMPI_Comm_group(w(c), g);
}
int MPI_Comm_create(MPI_Comm c, MPI_Group g, MPI_Comm* out) {
    return PMPI_Comm_create(w(c), g, out);
}
int MPI_Send(const void* b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c) {
    return PMPI_Send(b, n, t, to, tag, w(c));
}
int MPI_Bsend(const void* b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c) {
    return PMPI_Bsend(b, n, t, to, tag, w(c));
}
int MPI_Isend(const void* b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c,
              MPI_Request* q) {
    return PMPI_Isend(b, n, t, to, tag, w(c), q);
}
int MPI_Recv(void* b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c,
             MPI_Status* s) {
    return PMPI_Recv(b, n, t, from, tag, w(c), s);
}
int MPI_Irecv(void* b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c,
              MPI_Request* q) {
    return PMPI_Irecv(b, n, t, from, tag, w(c), q);
}
int MPI_Probe(int from, int tag, MPI_Comm c, MPI_Status* s) {
    return PMPI_Probe(from, tag, w(c), s);
}
int MPI_Allreduce(const void* a, void* b, int n, MPI_Datatype t, MPI_Op op, MPI_Comm c) {
    return PMPI_Allreduce(a, b, n, t, op, w(c));
}
int MPI_Alltoall(const void* a, int n, MPI_Datatype t, void* b, int m, MPI_Datatype u,
                 MPI_Comm c) {
    return PMPI_Alltoall(a, n, t, b, m, u, w(c));
}
int MPI_Alltoallv(const void* a, const int* n, const int* i, MPI_Datatype t, void* b,
                  const int* m, const int* j, MPI_Datatype u, MPI_Comm c) {
    return PMPI_Alltoallv(a, n, i, t, b, m, j, u, w(c));
}
int MPI_Gatherv(const void* a, int n, MPI_Datatype t, void* b, const int* m, const int* j,
                MPI_Datatype u, int root, MPI_Comm c) {
    return PMPI_Gatherv(a, n, t, b, m, j, u, root, w(c));
}
int MPI_Scatterv(const void* a, const int* n, const int* i, MPI_Datatype t, void* b,
                 int m, MPI_Datatype u, int root, MPI_Comm c) {
    return PMPI_Scatterv(a, n, i, t, b, m, u, root, w(c));
}

}  // extern "C"
