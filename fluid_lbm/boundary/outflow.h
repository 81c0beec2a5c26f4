// SPDX-License-Identifier: GPL-2.0-or-later
// Cells at a side through which the flow leaves the box. The tangential velocity there is
// that of the next cell inwards, and all 19 populations are rebuilt from density,
// velocity and stress (regularised: Latt et al., Phys. Rev. E 77 (2008) 056703): stable
// close to relaxation time 1/2. A tangential velocity that is given at a face that flow
// leaves by would need a layer of thickness viscosity over speed, which no grid resolves.
#pragma once

#include "fluid_lbm/boundary/boundaries.h"
#include "fluid_lbm/lattice/equilibrium.h"

namespace magfsi::fluid {

// A cell at a side, and the next one inwards: where their populations are, by
// arrangement.
struct OutflowCell {
    CellSlots slots[2], inner_slots[2];
};

// cells: local indices.
std::vector<OutflowCell> outflow_cells(const SideContext& in, int side,
                                       const std::vector<Cell>& cells);

// Throws std::invalid_argument where a rank has no cell behind one at the side.
void check_depth(const Decomposition& decomposition, int side);

// outward: 1 at a high side, -1 at a low one. f: in, what streams to the cell; out, all
// 19 from the flow.
void rebuild(double (&f)[d3q19::directions], int axis, int outward,
             const LocalFlow& flow);

template <class Real>
void gather(const Real* base, const CellSlots& slots, double (&f)[d3q19::directions]) {
    for (int q = 0; q < d3q19::directions; ++q) f[q] = base[slots[q]];
}

template <class Real>
void scatter(const double (&f)[d3q19::directions], const CellSlots& slots, Real* base) {
    for (int q = 0; q < d3q19::directions; ++q) base[slots[q]] = static_cast<Real>(f[q]);
}

}  // namespace magfsi::fluid
