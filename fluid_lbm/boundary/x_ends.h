// The two ends of a row in the swapped arrangement. Populations with a velocity along x
// that enter the row there are read and written by the kernel in a ghost element; its
// partner is the other end of the same array (periodic) or the row's own slot (half-way
// bounce-back). Walls along y and z need nothing of the kind: they are a substitution of
// the row's pointer, in swapped_pointers().
#pragma once

#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

// Real: float or double.
// The partner's value into the ghost element, before the kernel.
template <class Real>
void open_x_ends(const RowPointers<Real>& p, const RowLayout& layout);
// Asks for what the next row's open_x_ends will read, shift elements further: one cache
// line a population at the far end of a row, which nothing else has asked for by then.
template <class Real>
void prefetch_x_ends(const RowPointers<Real>& p, const RowLayout& layout,
                     std::ptrdiff_t shift) {
    for (int q = 1; q < d3q19::directions; ++q) {
        if (d3q19::c[q][0] == 0) continue;
        __builtin_prefetch(p.at[q] + shift + (d3q19::c[q][0] > 0 ? layout.nx : -1), 1, 3);
    }
}
// The ghost element's value back to its partner, after the kernel.
template <class Real>
void close_x_ends(const RowPointers<Real>& p, const RowLayout& layout);

}  // namespace magfsi::fluid
