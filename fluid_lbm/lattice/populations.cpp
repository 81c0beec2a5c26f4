#include "fluid_lbm/lattice/populations.h"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>

namespace magfsi::fluid {

namespace {

constexpr std::ptrdiff_t line = 64;  // bytes
constexpr std::ptrdiff_t page = 4096;
constexpr std::ptrdiff_t array_skew = 5;  // cache lines between arrays modulo the page
constexpr std::ptrdiff_t huge_page = std::ptrdiff_t{1} << 21;

std::ptrdiff_t round_up(std::ptrdiff_t value, std::ptrdiff_t unit) {
    return (value + unit - 1) / unit * unit;
}

std::ptrdiff_t size_of(Storage storage) {
    return storage == Storage::float_ ? sizeof(float) : sizeof(double);
}

std::ptrdiff_t row_bytes_of(int row_length, Storage storage) {
    return round_up((row_length + 1) * size_of(storage), line);
}

std::ptrdiff_t array_bytes_of(int row_count, std::ptrdiff_t row_bytes) {
    return round_up(row_count * row_bytes, page) + array_skew * line;
}

// Huge pages but for a rest that does not fill one: a rank has 2 MB at most to lose, 6 %
// of a small box on two ranks.
void advise(char* memory, std::ptrdiff_t bytes) {
    const std::ptrdiff_t whole = bytes / huge_page * huge_page;
    madvise(memory, whole, MADV_HUGEPAGE);  // advice: no harm if refused
    madvise(memory + whole, bytes - whole, MADV_NOHUGEPAGE);
}

}  // namespace

std::size_t Populations::bytes_of(int row_length, int row_count, Storage storage) {
    return d3q19::directions *
               array_bytes_of(row_count, row_bytes_of(row_length, storage)) +
           line;
}

void Populations::Free::operator()(void* memory) const {
    std::free(memory);
}

Populations::Populations(int row_length, int row_count, Storage storage)
    : storage_(storage) {
    const std::ptrdiff_t size = size_of(storage);
    const std::ptrdiff_t row_bytes = row_bytes_of(row_length, storage);
    const std::ptrdiff_t array_bytes = array_bytes_of(row_count, row_bytes);
    row_stride_ = row_bytes / size;
    array_stride_ = array_bytes / size;
    bytes_ = round_up(
        static_cast<std::ptrdiff_t>(bytes_of(row_length, row_count, storage)), page);
    void* memory = nullptr;
    if (posix_memalign(&memory, huge_page, bytes_) != 0) throw std::bad_alloc();
    memory_.reset(memory);
    advise(static_cast<char*>(memory), bytes_);
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

}  // namespace magfsi::fluid
