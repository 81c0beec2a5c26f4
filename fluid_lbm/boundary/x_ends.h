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
// The ghost element's value back to its partner, after the kernel.
template <class Real>
void close_x_ends(const RowPointers<Real>& p, const RowLayout& layout);

}  // namespace magfsi::fluid
