// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/bench/lbm/measure.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace magfsi::bench {

namespace {

constexpr std::ptrdiff_t doubles_a_line = 8;
constexpr std::size_t huge_page = std::size_t{1} << 21;
constexpr std::ptrdiff_t lines_ahead = 16;

// One part a thread would pay for its start and end; 64 KiB hide both.
constexpr std::ptrdiff_t chunk = 1024;  // lines

[[gnu::target_clones("avx512f", "avx2", "default")]] void change(double* a,
                                                                 std::ptrdiff_t lines) {
    for (std::ptrdiff_t line = 0; line < lines; ++line, a += doubles_a_line) {
        __builtin_prefetch(a + lines_ahead * doubles_a_line, 1, 3);
        for (std::ptrdiff_t i = 0; i < doubles_a_line; ++i) a[i] = 1.0 - a[i];
    }
}

}  // namespace

void InPlaceCopy::Free::operator()(double* memory) const {
    std::free(memory);
}

InPlaceCopy::InPlaceCopy(MPI_Comm comm, std::size_t bytes)
    : comm_(comm), lines_(static_cast<std::ptrdiff_t>(bytes / 64 / chunk * chunk)) {
    void* memory = nullptr;
    const std::size_t size = (bytes + huge_page - 1) / huge_page * huge_page;
    if (posix_memalign(&memory, huge_page, size) != 0) throw std::bad_alloc();
    memory_.reset(static_cast<double*>(memory));
    madvise(memory, size, MADV_HUGEPAGE);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t first = 0; first < lines_; first += chunk) {
        std::fill_n(memory_.get() + first * doubles_a_line, chunk * doubles_a_line, 0.25);
    }
}

void InPlaceCopy::pass() {
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t first = 0; first < lines_; first += chunk) {
        change(memory_.get() + first * doubles_a_line, chunk);
    }
}

double InPlaceCopy::bytes_per_second(double seconds) {
    double bytes = 0, elapsed = 0;
    MPI_Barrier(comm_);
    const double start = MPI_Wtime();
    do {
        pass();
        bytes += 2.0 * 64 * static_cast<double>(lines_);
        elapsed = MPI_Wtime() - start;
    } while (elapsed < seconds);
    double rate = bytes / elapsed;
    MPI_Allreduce(MPI_IN_PLACE, &rate, 1, MPI_DOUBLE, MPI_SUM, comm_);
    return rate;
}

}  // namespace magfsi::bench
