#include "fluid_lbm/lattice/populations.h"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>

namespace magfsi::fluid {

namespace {

using namespace d3q19;

constexpr std::ptrdiff_t line = 8;        // doubles in a cache line of 64 bytes
constexpr std::ptrdiff_t page = 512;      // doubles in 4 KiB
constexpr std::ptrdiff_t array_skew = 5;  // cache lines between arrays modulo the page
constexpr std::size_t huge_page = std::size_t{1} << 21;

std::ptrdiff_t round_up(std::ptrdiff_t value, std::ptrdiff_t unit) {
    return (value + unit - 1) / unit * unit;
}

}  // namespace

void Populations::Free::operator()(double* memory) const {
    std::free(memory);
}

Populations::Populations(int row_length, int row_count)
    : row_stride_(round_up(row_length + 1, line)),
      array_stride_(round_up(row_count * row_stride_, page) + array_skew * line) {
    const std::size_t doubles = directions * array_stride_ + line;
    bytes_ = round_up(doubles * sizeof(double), huge_page);
    void* memory = nullptr;
    if (posix_memalign(&memory, huge_page, bytes_) != 0) throw std::bad_alloc();
    memory_.reset(static_cast<double*>(memory));
    madvise(memory, bytes_, MADV_HUGEPAGE);  // advice: no harm if refused
    std::memset(memory, 0, bytes_);
    first_ = memory_.get() + line;  // row 0 has an element -1 too
}

RowPointers natural_pointers(const Populations& populations, const RowLayout& layout,
                             int y, int z) {
    RowPointers p{};
    const int row = layout.row(y, z);
    for (int q = 0; q < directions; ++q) p.at[q] = p.own[q] = populations.row(q, row);
    return p;
}

RowPointers swapped_pointers(const Populations& populations, const RowLayout& layout,
                             int y, int z) {
    RowPointers p{};
    const int row = layout.row(y, z);
    const UpstreamRows upstream = layout.upstream(y, z);
    for (int q = 0; q < directions; ++q) {
        const int from = upstream.at[c[q][1] + 1][c[q][2] + 1];
        p.own[q] = populations.row(q, row);
        p.bounced[q] = from < 0;
        p.at[q] = from < 0 ? p.own[q] : populations.row(opposite(q), from) - c[q][0];
    }
    return p;
}

RowPointers pointers(const Populations& populations, const RowLayout& layout,
                     Arrangement arrangement, int y, int z) {
    return arrangement == Arrangement::natural
               ? natural_pointers(populations, layout, y, z)
               : swapped_pointers(populations, layout, y, z);
}

}  // namespace magfsi::fluid
