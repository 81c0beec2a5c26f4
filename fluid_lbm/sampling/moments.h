// SPDX-License-Identifier: GPL-2.0-or-later
// Reading and writing of density, momentum, flow and populations of rows in either
// arrangement; lattice units. Rows are in local indices.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/grid/cells.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/streaming/kernel_choice.h"

namespace magfsi::fluid {

// Moments of some cells of one row.
struct RowMoments {
    std::vector<double> excess;            // density - 1
    std::array<std::vector<double>, 3> j;  // sum of c f, by component
};

// View of a rank's populations: all that sampling and sweeping need.
struct View {
    const Populations& populations;
    const RowLayout& layout;
    Arrangement arrangement;
    const AnyKernels& kernels;
    const CollisionParameters& parameters;
};

// Moments of the cells x_begin <= x < x_end of an owned row. In the swapped arrangement
// the ghost rows must be filled. Overwrites the ghost elements at the row's ends, which
// are free between steps.
void row_moments(const View& view, int y, int z, int x_begin, int x_end,
                 RowMoments& moments);

// Reads the flow (refinement/flow_kernel.h) of a row's cells: flow_numbers arrays one
// after the other.
void read_flow(const View& view, const CellRow& row, double* flow);
// The same with an array for each number; the stress is read only if its first array is
// not null.
void read_flow(const View& view, const CellRow& row,
               const std::array<double*, flow_numbers>& flow);
// Replaces a row's populations by those of a flow; ghost modes become zero.
void write_flow(const View& view, const CellRow& row, const double* flow);
// The same for a piece of a plane z, column by column along y, in the natural arrangement
// only: rows that are as short as a ring is wide fill no vector. flow: [x][number][y].
void write_flow_along_y(const View& view, const CellBox& plane, const double* flow);
// Adds `excess` times the weights to the populations of a row: the density rises by
// `excess`, the momentum stays.
void add_density(const View& view, const CellRow& row, double excess);
// Reads and writes a row's populations, one direction after the other.
void read_populations(const View& view, const CellRow& row, double* values);
void write_populations(const View& view, const CellRow& row, const double* values);

// Reads and writes all populations of a plane of cells, to save and restore a state. z:
// local index; values: [y][x][19] of the rank's cells, the populations that have arrived,
// as deviations from rest.
void read_plane(const View& view, int z, std::span<double> values);
void write_plane(const View& view, int z, std::span<const double> values);

}  // namespace magfsi::fluid
