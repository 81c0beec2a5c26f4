// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/lattice/populations.h"

#include <sys/mman.h>

#include <cstring>
#include <new>
#include <vector>

namespace magfsi::fluid {

namespace {

constexpr std::ptrdiff_t line = 64;  // bytes of a cache line
constexpr std::ptrdiff_t page = 4096;
// Distance from one array to the next modulo the page, in cache lines.
constexpr std::ptrdiff_t array_skew = 5;
constexpr std::ptrdiff_t huge_page = std::ptrdiff_t{1} << 21;

std::ptrdiff_t round_up(std::ptrdiff_t value, std::ptrdiff_t unit) {
    return (value + unit - 1) / unit * unit;
}

std::ptrdiff_t size_of(Precision precision) {
    return precision == Precision::float_ ? sizeof(float) : sizeof(double);
}

// Bytes of a padded row: one element more than it has cells, for the ghost, rounded up to
// whole cache lines.
std::ptrdiff_t row_bytes_of(int row_length, Precision precision) {
    return round_up((row_length + 1) * size_of(precision), line);
}

// Bytes from one direction's array to the next one's.
std::ptrdiff_t array_bytes_of(int row_count, std::ptrdiff_t row_bytes) {
    return round_up(row_count * row_bytes, page) + array_skew * line;
}

// Asks for huge pages, except for a remainder that does not fill one: whole huge pages
// would waste up to 2 MB per rank, 6 % of a small box on two ranks.
void advise(char* memory, std::ptrdiff_t bytes) {
    const std::ptrdiff_t whole = bytes / huge_page * huge_page;
    madvise(memory, whole, MADV_HUGEPAGE);  // advice: no harm if refused
    madvise(memory + whole, bytes - whole, MADV_NOHUGEPAGE);
}

// Memory of destroyed populations, kept for those that follow once
// keep_memory_of_populations() has been called.
struct Spare {
    ~Spare() {
        for (const Block& block : blocks) std::free(block.memory);
    }
    struct Block {
        void* memory = nullptr;
        std::size_t bytes = 0;
    };
    static constexpr std::size_t most_blocks = 8;
    bool is_wanted = false;
    std::vector<Block> blocks;  // the oldest first

    // Takes out the smallest block that is large enough and at most twice as large; an
    // empty block if there is none.
    Block take(std::size_t bytes) {
        auto best = blocks.end();
        for (auto block = blocks.begin(); block != blocks.end(); ++block) {
            if (block->bytes < bytes || block->bytes > 2 * bytes) continue;
            if (best == blocks.end() || block->bytes < best->bytes) best = block;
        }
        if (best == blocks.end()) return {};
        const Block taken = *best;
        blocks.erase(best);
        return taken;
    }
    // Keeps a block and frees the oldest one above the limit. False if blocks are not
    // kept.
    bool keep(void* memory, std::size_t bytes) {
        if (!is_wanted) return false;
        blocks.push_back({memory, bytes});
        if (blocks.size() > most_blocks) {
            std::free(blocks.front().memory);
            blocks.erase(blocks.begin());
        }
        return true;
    }
};
Spare spare;

// Address of the partner of population q's ghost element, or null if q has none: it has
// no velocity along x, or it is bounced at a wall along y or z.
template <class Real>
Real* x_end_partner(const RowPointers<Real>& p, const RowLayout& layout, int q) {
    if (d3q19::c[q][0] == 0 || p.bounced[q]) return nullptr;
    const bool low = d3q19::c[q][0] > 0;  // enters at the low end
    if (layout.beyond_x == Beyond::wall) return p.own[q] + (low ? 0 : layout.nx - 1);
    return p.at[q] + (low ? layout.nx : -1);
}

}  // namespace

std::size_t Populations::bytes_of(int row_length, int row_count, Precision precision) {
    return d3q19::directions *
               array_bytes_of(row_count, row_bytes_of(row_length, precision)) +
           line;
}

void Populations::Free::operator()(void* memory) const {
    if (!spare.keep(memory, bytes)) std::free(memory);
}

void keep_memory_of_populations() {
    spare.is_wanted = true;
}

std::unique_ptr<void, Populations::Free> Populations::allocate(std::size_t bytes) {
    if (const Spare::Block block = spare.take(bytes); block.memory)
        return {block.memory, Free{block.bytes}};
    // The surplus serves a patch that is a few cells larger at its next place.
    if (spare.is_wanted) bytes += bytes / 8;
    void* memory = nullptr;
    if (posix_memalign(&memory, huge_page, bytes) != 0) throw std::bad_alloc();
    advise(static_cast<char*>(memory), static_cast<std::ptrdiff_t>(bytes));
    return {memory, Free{bytes}};
}

Populations::Populations(int row_length, int row_count, Precision precision)
    : precision_(precision) {
    const std::ptrdiff_t size = size_of(precision);
    const std::ptrdiff_t row_bytes = row_bytes_of(row_length, precision);
    const std::ptrdiff_t array_bytes = array_bytes_of(row_count, row_bytes);
    row_stride_ = row_bytes / size;
    array_stride_ = array_bytes / size;
    bytes_ = round_up(
        static_cast<std::ptrdiff_t>(bytes_of(row_length, row_count, precision)), page);
    memory_ = allocate(bytes_);
    void* const memory = memory_.get();
    char* const first = static_cast<char*>(memory) + line;  // row 0 has an element -1 too
    first_ = first;
    std::memset(memory, 0, line);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < row_count; ++row) {
        for (int q = 0; q < d3q19::directions; ++q) {
            std::memset(first + q * array_bytes + row * row_bytes, 0, row_bytes);
        }
    }
}

Crossing cross(int index, int count, const std::array<Beyond, 2>& sides) {
    if (index >= 0 && index < count) return {index, false};
    const Beyond side = index < 0 ? sides[0] : sides[1];
    if (side == Beyond::wall) return {index, true};
    if (side == Beyond::wrap) return {index < 0 ? index + count : index - count, false};
    return {index, false};
}

UpstreamRows RowLayout::upstream(int y, int z) const {
    UpstreamRows rows{};
    Crossing across_y[3], across_z[3];
    for (int c = -1; c <= 1; ++c) {
        across_y[c + 1] = cross(y - c, ny, beyond_y);
        across_z[c + 1] = cross(z - c, nz, beyond_z);
    }
    for (int cy = 0; cy < 3; ++cy) {
        for (int cz = 0; cz < 3; ++cz) {
            const bool wall = across_y[cy].wall || across_z[cz].wall;
            rows.at[cy][cz] = wall ? -1 : row(across_y[cy].index, across_z[cz].index);
        }
    }
    return rows;
}

template <class Real>
void open_x_ends(const RowPointers<Real>& p, const RowLayout& layout) {
    for (int q = 1; q < d3q19::directions; ++q) {
        const Real* partner = x_end_partner(p, layout, q);
        if (partner != nullptr)
            p.at[q][d3q19::c[q][0] > 0 ? 0 : layout.nx - 1] = *partner;
    }
}

template <class Real>
void close_x_ends(const RowPointers<Real>& p, const RowLayout& layout) {
    for (int q = 1; q < d3q19::directions; ++q) {
        Real* partner = x_end_partner(p, layout, q);
        if (partner != nullptr)
            *partner = p.at[q][d3q19::c[q][0] > 0 ? 0 : layout.nx - 1];
    }
}

template <class Real>
void rest_x_ends(const RowPointers<Real>& p, const RowLayout& layout) {
    for (int q = 1; q < d3q19::directions; ++q) {
        if (d3q19::c[q][0] == 0 || p.bounced[q]) continue;
        p.at[q][d3q19::c[q][0] > 0 ? 0 : layout.nx - 1] = 0;
    }
}

template void open_x_ends(const RowPointers<double>&, const RowLayout&);
template void open_x_ends(const RowPointers<float>&, const RowLayout&);
template void close_x_ends(const RowPointers<double>&, const RowLayout&);
template void close_x_ends(const RowPointers<float>&, const RowLayout&);
template void rest_x_ends(const RowPointers<double>&, const RowLayout&);
template void rest_x_ends(const RowPointers<float>&, const RowLayout&);

}  // namespace magfsi::fluid
