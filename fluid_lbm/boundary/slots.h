// Where the population that has arrived in a cell is stored, cell by cell: for boundaries
// and obstacles, which touch few cells and keep lists of slots. The sweep does the same
// for whole rows (lattice/populations.h, boundary/x_ends.h).
//
// Two facts carry all boundary code. After the sweep and the exchange
//   - population q that arrived in a cell is at slot(q) of the new arrangement; behind a
//     wall side that is the cell's own array q in both arrangements, and it holds the
//     cell's outgoing population opposite(q): half-way bounce-back;
//   - the outgoing population q of a cell is still at slot(opposite(q)) of the old
//     arrangement, as long as nothing has overwritten what arrived at its goal.
#pragma once

#include <array>
#include <cstddef>

#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

// Element offsets from rows.row(0, 0), by q.
using CellSlots = std::array<std::ptrdiff_t, d3q19::directions>;

template <class Real>
CellSlots cell_slots(const PopulationRows<Real>& rows, const RowLayout& layout,
                     Arrangement arrangement, const std::array<int, 3>& cell) {
    const RowPointers<Real> p = pointers(rows, layout, arrangement, cell[1], cell[2]);
    const Real* const base = rows.row(0, 0);
    CellSlots slots;
    for (int q = 0; q < d3q19::directions; ++q) {
        const Real* at = p.at[q] + cell[0];
        const int from = cell[0] - d3q19::c[q][0];
        const bool beyond = from < 0 || from >= layout.nx;
        if (arrangement == Arrangement::swapped && beyond && !p.bounced[q]) {
            at = layout.beyond_x == Beyond::wall
                     ? p.own[q] + cell[0]
                     : at + (from < 0 ? layout.nx : -layout.nx);
        }
        slots[q] = at - base;
    }
    return slots;
}

// The direction with these components, -1 if the lattice has none.
constexpr int direction(int cx, int cy, int cz) {
    for (int q = 0; q < d3q19::directions; ++q) {
        if (d3q19::c[q][0] == cx && d3q19::c[q][1] == cy && d3q19::c[q][2] == cz) {
            return q;
        }
    }
    return -1;
}

}  // namespace magfsi::fluid
