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

#include "fluid_lbm/lattice/d3q19.h"
#include "fluid_lbm/lattice/row_layout.h"

namespace magfsi::fluid {

enum class Arrangement { natural, swapped };

class Populations {
  public:
    // All at rest with density 1, natural.
    Populations(int row_length, int row_count);

    // Element 0 of a row, 64-byte aligned; elements -1 and row_length may be used too.
    // The object is a view on its memory: const does not reach the values.
    double* row(int q, int row) const {
        return first_ + q * array_stride_ + row * row_stride_;
    }
    std::ptrdiff_t row_stride() const { return row_stride_; }
    std::size_t bytes() const { return bytes_; }

  private:
    struct Free {
        void operator()(double* memory) const;
    };
    std::ptrdiff_t row_stride_ = 0, array_stride_ = 0;
    std::size_t bytes_ = 0;
    std::unique_ptr<double[], Free> memory_;
    double* first_ = nullptr;
};

// The slots that one row reads and writes in one step. at[q] points to the slot of
// population q that arrives at cell 0 of the row; the kernel writes the outgoing
// population q to at[opposite(q)]. Every slot belongs to one row only, so rows may run in
// any order.
struct RowPointers {
    double* at[d3q19::directions];
    double* own[d3q19::directions];   // slot q of the row itself
    bool bounced[d3q19::directions];  // population comes from a wall along y or z
};

RowPointers natural_pointers(const Populations& populations, const RowLayout& layout,
                             int y, int z);
RowPointers swapped_pointers(const Populations& populations, const RowLayout& layout,
                             int y, int z);
RowPointers pointers(const Populations& populations, const RowLayout& layout,
                     Arrangement arrangement, int y, int z);

}  // namespace magfsi::fluid
