// SPDX-License-Identifier: GPL-2.0-or-later
// GoogleTest under mpirun: rank 0 prints, a failure on any rank fails all.
#include <gtest/gtest.h>
#include <mpi.h>

#include "base/process/keep_libraries.h"

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    ::testing::InitGoogleTest(&argc, argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    if (rank != 0) delete listeners.Release(listeners.default_result_printer());
    int failed = RUN_ALL_TESTS();
    if (rank != 0 && failed != 0) {
        std::fprintf(stderr, "rank %d: a test failed\n", rank);
    }
    int any = 0;
    MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    magfsi::keep_libraries();
    MPI_Finalize();
    return any;
}
