// SPDX-License-Identifier: GPL-2.0-or-later
// Density and momentum, and the populations themselves, of rows in either arrangement;
// lattice units.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/streaming/kernel_choice.h"
#include "grid/cells.h"

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

// The flow_numbers of those cells (refinement/flow_kernel.h), one number after the other,
// and populations made of such: ghost modes are gone.
void read_flow(const View& view, const CellRow& row, double* flow);
// Each number into an array of its own, the stress only if its first is there.
void read_flow(const View& view, const CellRow& row,
               const std::array<double*, flow_numbers>& flow);
void write_flow(const View& view, const CellRow& row, const double* flow);
// The same for a piece of a plane z, column by column along y, and in the natural
// arrangement only: rows as short as a ring is wide fill no vector.
void write_flow_along_y(const View& view, const CellBox& plane, const double* flow);
// Changes the density by so much, at the velocity zero.
void add_density(const View& view, const CellRow& row, double excess);
// Their populations, one direction after the other.
void read_populations(const View& view, const CellRow& row, double* values);
void write_populations(const View& view, const CellRow& row, const double* values);

// All populations of a plane of cells, for a state that is saved and restored. z: local
// index; values: [y][x][19] of the rank's cells, those that have arrived, as deviations
// from rest.
void read_plane(const View& view, int z, std::span<double> values);
void write_plane(const View& view, int z, std::span<const double> values);

}  // namespace magfsi::fluid
