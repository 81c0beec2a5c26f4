// Density and momentum from the populations, in either arrangement, lattice units.
#pragma once

#include <array>
#include <vector>

#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/streaming/kernel_choice.h"

namespace magfsi::fluid {

// Of some cells of one row.
struct RowMoments {
    std::vector<double> excess;            // density - 1
    std::array<std::vector<double>, 3> j;  // sum of c f
};

// What all sampling reads.
struct View {
    const Populations& populations;
    const RowLayout& layout;
    Arrangement arrangement;
    const AnyKernels& kernels;
};

// Cells x_begin <= x < x_end of an owned row. In the swapped arrangement the ghost rows
// must be filled. Writes the ghost elements at the row's ends, which are free between
// steps.
void row_moments(const View& view, int y, int z, int x_begin, int x_end,
                 RowMoments& moments);

// Population q that has arrived at a cell, minus its weight.
double population(const View& view, int q, int x, int y, int z);

}  // namespace magfsi::fluid
