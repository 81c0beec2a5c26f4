// SPDX-License-Identifier: GPL-2.0-or-later
// Cells at a side through which the flow leaves the box. Their tangential velocity is
// that of the next cell inwards, and all 19 populations are rebuilt from density,
// velocity and stress (regularised: Latt et al. 2008), which is stable close to
// relaxation time 1/2. A prescribed tangential velocity on a face that flow leaves by
// would need a layer of thickness viscosity over speed, which no grid resolves.
#pragma once

#include "fluid_lbm/boundary/boundaries.h"
#include "fluid_lbm/lattice/equilibrium.h"

namespace magfsi::fluid {

// Slots of the populations of a cell at a side and of the next cell inwards, by
// arrangement.
struct OutflowCell {
    CellSlots slots[2], inner_slots[2];
};

// The slots of cells (local indices) at a side.
std::vector<OutflowCell> outflow_cells(const SideContext& in, int side,
                                       const std::vector<Cell>& cells);

// Throws std::invalid_argument if the box of any rank has no second cell behind the one
// at the side.
void check_depth(const Decomposition& decomposition, int side);

// Replaces the populations of a cell at a side by those of `flow`, with the stress of the
// populations that have streamed to the cell. f: the 19 populations, in and out; outward:
// 1 at a high side, -1 at a low one.
void rebuild(double (&f)[d3q19::directions], int axis, int outward,
             const LocalFlow& flow);

// Reads the 19 populations of a cell from memory, and writes them back.
template <class Real>
void gather(const Real* base, const CellSlots& slots, double (&f)[d3q19::directions]) {
    for (int q = 0; q < d3q19::directions; ++q) f[q] = base[slots[q]];
}

template <class Real>
void scatter(const double (&f)[d3q19::directions], const CellSlots& slots, Real* base) {
    for (int q = 0; q < d3q19::directions; ++q) base[slots[q]] = static_cast<Real>(f[q]);
}

}  // namespace magfsi::fluid
