// Storage of the 19 distribution functions of one rank, as f - w (the deviation from
// rest): about three digits more than f itself at low speeds.
//
// Full structure of arrays: one array a direction, each made of padded rows. One element
// of padding serves as the ghost on both ends of a row, because a direction needs a ghost
// on one end only. Arrays start a few cache lines apart modulo the page, or the 19
// streams of a kernel would fall into the same cache sets.
//
// In-place streaming (the AA pattern: Bailey et al., 2009) alternates two arrangements:
//   natural: slot q of cell x holds the population q that has arrived at x;
//   swapped: slot opposite(q) of cell x - c_q holds it; behind a wall, slot q of x
//   itself.
// Both are complete states before collision.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "fluid_lbm/lattice/d3q19.h"
#include "fluid_lbm/lattice/row_layout.h"

namespace magfsi::fluid {

enum class Arrangement { natural, swapped };
enum class Storage { double_, float_ };

// The rows of populations as numbers of one type. A view on memory: const does not reach
// the values.
template <class Real>
class PopulationRows {
  public:
    PopulationRows(Real* first, std::ptrdiff_t array_stride, std::ptrdiff_t row_stride)
        : first_(first), array_stride_(array_stride), row_stride_(row_stride) {}

    // Element 0 of a row, 64-byte aligned; elements -1 and row_length may be used too.
    Real* row(int q, int row) const {
        return first_ + q * array_stride_ + row * row_stride_;
    }

  private:
    Real* first_;
    std::ptrdiff_t array_stride_, row_stride_;
};

class Populations {
  public:
    // All at rest with density 1, natural. Threads touch first the rows that the sweep
    // will give them.
    Populations(int row_length, int row_count, Storage storage);

    // What that takes, padding included.
    static std::size_t bytes_of(int row_length, int row_count, Storage storage);

    // use(rows), rows being PopulationRows<double> or PopulationRows<float>: the way of
    // everything that reads or writes populations outside the kernels.
    template <class Use>
    decltype(auto) visit(Use&& use) const {
        if (storage_ == Storage::float_) return use(rows<float>());
        return use(rows<double>());
    }
    // Real must be the storage's type.
    template <class Real>
    PopulationRows<Real> rows() const {
        return {static_cast<Real*>(first_), array_stride_, row_stride_};
    }

    Storage storage() const { return storage_; }
    std::size_t element_bytes() const {
        return storage_ == Storage::float_ ? sizeof(float) : sizeof(double);
    }
    std::ptrdiff_t row_stride() const { return row_stride_; }  // elements
    std::size_t bytes() const { return bytes_; }
    std::span<std::byte> all_bytes() const {
        return {static_cast<std::byte*>(memory_.get()), bytes_};
    }
    void* memory() const { return first_; }
    std::ptrdiff_t offset(int q, int row) const {  // bytes from memory()
        return (q * array_stride_ + row * row_stride_) *
               static_cast<std::ptrdiff_t>(element_bytes());
    }

  private:
    struct Free {
        void operator()(void* memory) const;
    };
    Storage storage_;
    std::ptrdiff_t row_stride_ = 0, array_stride_ = 0;  // elements
    std::size_t bytes_ = 0;
    std::unique_ptr<void, Free> memory_;
    void* first_ = nullptr;
};

// The slots that one row reads and writes in one step. at[q] points to the slot of
// population q that arrives at cell 0 of the row; the kernel writes the outgoing
// population q to at[opposite(q)]. Every slot belongs to one row only, so rows may run in
// any order.
template <class Real>
struct RowPointers {
    Real* at[d3q19::directions];
    Real* own[d3q19::directions];     // slot q of the row itself
    bool bounced[d3q19::directions];  // population comes from a wall along y or z
};

template <class Real>
RowPointers<Real> natural_pointers(const PopulationRows<Real>& rows,
                                   const RowLayout& layout, int y, int z) {
    RowPointers<Real> p{};
    const int row = layout.row(y, z);
    for (int q = 0; q < d3q19::directions; ++q) p.at[q] = p.own[q] = rows.row(q, row);
    return p;
}

template <class Real>
RowPointers<Real> swapped_pointers(const PopulationRows<Real>& rows,
                                   const RowLayout& layout, int y, int z) {
    using namespace d3q19;
    RowPointers<Real> p{};
    const int row = layout.row(y, z);
    const UpstreamRows upstream = layout.upstream(y, z);
    for (int q = 0; q < directions; ++q) {
        const int from = upstream.at[c[q][1] + 1][c[q][2] + 1];
        p.own[q] = rows.row(q, row);
        p.bounced[q] = from < 0;
        p.at[q] = from < 0 ? p.own[q] : rows.row(opposite(q), from) - c[q][0];
    }
    return p;
}

template <class Real>
RowPointers<Real> pointers(const PopulationRows<Real>& rows, const RowLayout& layout,
                           Arrangement arrangement, int y, int z) {
    return arrangement == Arrangement::natural ? natural_pointers(rows, layout, y, z)
                                               : swapped_pointers(rows, layout, y, z);
}

}  // namespace magfsi::fluid
