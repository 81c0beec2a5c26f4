// The populations of a few cells in a row, one cell a lane, where they lie in memory: a
// collision reads those that have arrived and writes those that leave.
//
// Read through, not copied: 19 vectors do not fit into the 16 registers of AVX2, and a
// copy would go to the stack and back.
#pragma once

#include <cstddef>

#include "fluid_lbm/collision/simd.h"

namespace magfsi::fluid {

template <class V, class Real>
class LaneCells {
  public:
    using Vector = V;
    MAGFSI_INLINE LaneCells(Real* const* at, std::ptrdiff_t x) : at_(at), x_(x) {}

    // Population minus weight. Of a pair of opposites read both before either leaves:
    // each is written where the other one came from.
    MAGFSI_INLINE V operator[](int q) const { return load<V>(at_[q] + x_); }
    MAGFSI_INLINE void leave(int q, const V& f) const {
        store(at_[d3q19::opposite(q)] + x_, f);
    }

  private:
    Real* const* at_;
    std::ptrdiff_t x_;
};

}  // namespace magfsi::fluid
