// The cells that a marker reads its velocity from and gives its force to: the same
// weights both ways, so that power is conserved (interpolation and spreading are
// adjoint).
#pragma once

#include <array>

#include "coupler/immersed_boundary/delta_kernel.h"
#include "coupler/immersed_boundary/grid.h"

namespace magfsi::coupler {

// Product of three one-dimensional stencils. Beyond a wall there is no fluid: those
// weights are dropped and the rest scaled up, which keeps the partition of unity. Across
// a periodic side the indices wrap when used.
using MarkerStencil = std::array<Stencil1D, 3>;

// Throws Diverged when the point lies outside a box without periodic sides.
void set_stencil(MarkerStencil& stencil, const Grid& grid, Kernel kernel,
                 const Vec3& point_m);
MarkerStencil marker_stencil(const Grid& grid, Kernel kernel, const Vec3& point_m);

// Index wrapped into [0, cells): more than once where a kernel is wider than the box.
inline int wrapped(int index, int cells) {
    while (index < 0) index += cells;
    while (index >= cells) index -= cells;
    return index;
}

}  // namespace magfsi::coupler
