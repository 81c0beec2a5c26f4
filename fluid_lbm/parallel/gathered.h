// Values of all ranks, one rank after the other, on every rank.
#pragma once

#include <mpi.h>

#include <numeric>
#include <vector>

namespace magfsi::fluid {

// Collective.
inline std::vector<int> gathered(MPI_Comm comm, const std::vector<int>& mine) {
    int ranks = 0;
    MPI_Comm_size(comm, &ranks);
    const int count = static_cast<int>(mine.size());
    std::vector<int> counts(static_cast<std::size_t>(ranks)), first(counts);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
    std::exclusive_scan(counts.begin(), counts.end(), first.begin(), 0);
    std::vector<int> all(static_cast<std::size_t>(first.back() + counts.back()));
    MPI_Allgatherv(mine.data(), count, MPI_INT, all.data(), counts.data(), first.data(),
                   MPI_INT, comm);
    return all;
}

}  // namespace magfsi::fluid
