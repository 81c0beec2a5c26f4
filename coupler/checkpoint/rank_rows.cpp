// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/checkpoint/rank_rows.h"

#include <algorithm>
#include <numeric>

namespace magfsi::coupler {

namespace {

int rank_in(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

std::size_t size_of(MPI_Comm comm) {
    int size = 1;
    MPI_Comm_size(comm, &size);
    return size;
}

// Concatenates the ranks' numbers on rank 0, in the order of the ranks.
template <class T>
std::vector<T> gather_all(MPI_Comm comm, std::span<const T> mine, MPI_Datatype type) {
    const int count = mine.size();
    std::vector<int> counts(size_of(comm)), starts(counts);
    MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    const bool root = rank_in(comm) == 0;
    std::vector<T> all(root ? static_cast<std::size_t>(starts.back() + counts.back())
                            : std::size_t{0});
    MPI_Gatherv(mine.data(), count, type, all.data(), counts.data(), starts.data(), type,
                0, comm);
    return all;
}

}  // namespace

std::vector<double> gather_rows(MPI_Comm comm, std::span<const int> index,
                                std::span<const double> rows, std::size_t width,
                                std::size_t count) {
    const auto places = gather_all<int>(comm, index, MPI_INT);
    const auto values = gather_all<double>(comm, rows, MPI_DOUBLE);
    if (rank_in(comm) != 0) return {};
    std::vector<double> sorted(width * count);
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                    sorted.begin() + places[i] * static_cast<std::ptrdiff_t>(width));
    }
    return sorted;
}

std::vector<double> gather_shares(MPI_Comm comm, std::span<const double> mine) {
    return gather_all<double>(comm, mine, MPI_DOUBLE);
}

std::vector<double> share_of(MPI_Comm comm, std::span<const double> rows,
                             std::size_t ranks_then) {
    const std::size_t rank = rank_in(comm);
    const std::size_t width = rows.size() / ranks_then;
    std::vector<double> share(width, 0.0);
    for (std::size_t r = 0; r < ranks_then; ++r) {
        const bool mine = ranks_then == size_of(comm) ? r == rank : rank == 0;
        for (std::size_t i = 0; mine && i < width; ++i) share[i] += rows[r * width + i];
    }
    return share;
}

}  // namespace magfsi::coupler
