// A rank's rows in the order of a step: those at cut sides first, so that their
// populations travel while the rest is computed.
#pragma once

#include <vector>

#include "fluid_lbm/lattice/row_layout.h"

namespace magfsi::fluid {

// Rows y_begin <= y < y_end, z alike.
struct RowBox {
    int y_begin = 0, y_end = 0, z_begin = 0, z_end = 0;
    int size() const { return (y_end - y_begin) * (z_end - z_begin); }
};

// Disjoint boxes that cover the rows with a neighbour's ghost row beside them.
std::vector<RowBox> rows_at_cuts(const RowLayout& layout);
// All others, in two halves: one for each axis of the exchange. May be empty.
std::vector<RowBox> inner_rows(const RowLayout& layout);

}  // namespace magfsi::fluid
