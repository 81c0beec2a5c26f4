// SPDX-License-Identifier: GPL-2.0-or-later
// Sums over a flow on a box mesh with cells of different sizes, and the flow's part of a
// checkpoint. Checkpoints are ordered by cells and faces of the whole box, so that a run
// can restart on other ranks.
#pragma once

#include <mpi.h>

#include <array>
#include <span>
#include <vector>

#include "adapters/solvers/openfoam/engine/engine.h"
#include "base/vector/vec3.h"
#include "coupler/checkpoint/state_file.h"

namespace magfsi::openfoam {

// Widths of a rank's cells along each axis [m]; cells are numbered with x fastest.
using Widths = std::array<std::vector<double>, 3>;

// Number of cells, indices along the axes of a cell, and volume of a cell [m3].
std::size_t cell_count(const Widths& width_m);
std::array<std::size_t, 3> index_of(const Widths& width_m, std::size_t cell);
double volume(const Widths& width_m, std::size_t cell);

// Sums and extremes over all cells of all ranks.
struct FlowSums {
    double volume_m3 = 0;
    Vec3 flow_m4_s{};              // integral of u
    double half_square_m5_s2 = 0;  // integral of u^2 / 2
    double enstrophy_1_s2 = 0;     // mean of |curl u|^2 / 2
    double max_speed_m_s = 0;
};

// `velocity` has three numbers a cell [m/s]; `vorticity` the same [1/s], or none, and
// then the enstrophy is 0. Collective.
FlowSums flow_sums(MPI_Comm comm, const Widths& width_m, const double* velocity,
                   std::span<const double> vorticity);

// This rank's cell with the highest speed.
struct FastestCell {
    std::size_t cell = 0;
    double speed_m_s = 0;  // NaN if any velocity is NaN
};
FastestCell fastest_cell(std::size_t cells, const double* velocity);

// Writes the flow into a checkpoint. `file` is null except on the root. Collective.
void save_flow(MPI_Comm comm, const BoxMesh& mesh, const FlowState& state,
               coupler::StateWriter* file);

// The same for a mesh that was read, which is on one rank: cells and faces in their
// order.
void save_listed_flow(const FlowState& state, coupler::StateWriter* file);
FlowState load_listed_flow(const Engine* engine, const coupler::StateReader& file);

// Reads this rank's part of a checkpoint. Throws coupler::StateFault if the file belongs
// to another mesh.
FlowState load_flow(const BoxMesh& mesh, const coupler::StateReader& file);

}  // namespace magfsi::openfoam
