// SPDX-License-Identifier: GPL-2.0-or-later
// A flow as numbers: sums over the cells of a box mesh, each cell with its volume, and a
// checkpoint by cells and faces of the whole box, whoever holds them.
#pragma once

#include <mpi.h>

#include <array>
#include <span>
#include <vector>

#include "adapters/openfoam/engine/engine.h"
#include "coupler/checkpoint/state_file.h"

namespace magfsi::openfoam {

// Of a rank's cells along each axis [m]; cells are numbered with x fastest.
using Widths = std::array<std::vector<double>, 3>;

std::size_t cell_count(const Widths& width_m);
std::array<std::size_t, 3> index_of(const Widths& width_m, std::size_t cell);
double volume(const Widths& width_m, std::size_t cell);

struct FlowSums {
    double volume_m3 = 0;
    std::array<double, 3> flow_m4_s{};  // integral of u
    double half_square_m5_s2 = 0;       // integral of u^2 / 2
    double enstrophy_1_s2 = 0;          // mean of |curl u|^2 / 2
    double max_speed_m_s = 0;
};

// velocity: three a cell; vorticity: the same, or empty. Collective.
FlowSums flow_sums(MPI_Comm comm, const Widths& width_m, const double* velocity,
                   std::span<const double> vorticity);

struct FastestCell {
    std::size_t cell = 0;
    double speed_m_s = 0;  // NaN where any is
};
FastestCell fastest_cell(std::size_t cells, const double* velocity);

// Collective; file is null but on the root.
void save_flow(MPI_Comm comm, const BoxMesh& mesh, const FlowState& state,
               coupler::StateWriter* file);

// This rank's part. Throws coupler::StateFault when the file is of another mesh.
FlowState load_flow(const BoxMesh& mesh, const coupler::StateReader& file);

}  // namespace magfsi::openfoam
