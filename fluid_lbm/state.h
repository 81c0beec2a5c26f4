// SPDX-License-Identifier: GPL-2.0-or-later
// The state of one rank's fluid in lattice units, for the files that implement Fluid
// (fluid.cpp, step.cpp, sampling/).
#pragma once

#include "fluid_lbm/boundary/boundaries.h"
#include "fluid_lbm/fluid.h"
#include "fluid_lbm/obstacle/obstacles.h"
#include "fluid_lbm/parallel/halo.h"
#include "fluid_lbm/sampling/moments.h"
#include "fluid_lbm/streaming/forced_rows.h"
#include "fluid_lbm/streaming/kept_state.h"
#include "fluid_lbm/streaming/sweep.h"

namespace magfsi::fluid {

// A duplicate of the user's communicator, so that messages of the fluid cannot be taken
// for those of its user. Construction is collective.
struct OwnedComm {
    explicit OwnedComm(MPI_Comm parent);
    ~OwnedComm();
    OwnedComm(const OwnedComm&) = delete;
    OwnedComm& operator=(const OwnedComm&) = delete;
    operator MPI_Comm() const { return comm; }

    MPI_Comm comm = MPI_COMM_NULL;
    int rank = 0, size = 1;
};

// Members are constructed in this order, each from those above it.
struct Fluid::State {
    // Sets up the initial flow of the configuration. Collective. Throws
    // std::invalid_argument on a configuration that cannot run.
    State(MPI_Comm parent, const FluidConfig& fluid_config);

    const FluidConfig config;
    const Units unit;
    const std::vector<double> rate_table;  // rates_by_stress() of a rheology, else empty
    const CollisionParameters parameters;
    const AnyKernels kernels;  // also decide the type that populations are stored as
    const OwnedComm comm;
    const Decomposition decomposition;
    const RowLayout layout;
    Populations populations;
    Arrangement arrangement = Arrangement::natural;
    std::int64_t steps_done = 0;
    Halo halo;
    // The rows that a step has to compute. Steps from the natural arrangement compute
    // all; steps from the swapped one leave out an outer layer that the caller fills
    // again afterwards (FluidConfig::refilled). x_ends: false if both ends of the rows
    // are filled so.
    struct Needed {
        std::vector<RowBox> at_cuts, inner;
        bool x_ends = true;
    };
    const Needed needed_from_natural, needed_from_swapped;
    const Needed& needed() const {
        return arrangement == Arrangement::natural ? needed_from_natural
                                                   : needed_from_swapped;
    }
    std::optional<ForcedRows> forces;  // forces of the next step; absent until one is set
    std::optional<Obstacles> obstacles;  // absent in a box without obstacles
    std::vector<std::unique_ptr<SideEffect>> side_effects;
    // The first cell that a step found invalid, and the number of steps done before that
    // step.
    std::optional<InvalidCell> invalid;
    std::int64_t invalid_step = 0;
    std::optional<KeptState> kept;  // present once keep() has been called
    bool again = false;  // true after go_back(): the coming step is a repetition

    const CellBox& owned() const { return decomposition.boxes[comm.rank]; }
    // View of the state before collision. It is complete between two steps in either
    // arrangement: ghost rows are filled and walls applied.
    View view() const { return {populations, layout, arrangement, kernels, parameters}; }
    std::size_t cells() const {  // cells that this rank owns
        return static_cast<std::size_t>(layout.nx) * layout.ny * layout.nz;
    }
    // True if the cell, in local indices, lies in an obstacle.
    bool is_solid(const Cell& cell) const {
        return obstacles && obstacles->map().solid(cell);
    }
    // This rank's part of a box of global indices, in local indices; empty if there is
    // none.
    CellBox local_part(const CellBox& box) const;
    // Creates the storage of forces unless it exists. body_force: lattice units, or
    // absent.
    void need_forces(const std::optional<Vec3>& body_force);
    // Sets the populations of the configured velocity and pressure; rest without them.
    void set_initial_flow();
    // Sets solid cells back to rest; must follow every change of populations from
    // outside.
    void reset_solid_cells();
};

// Calls use(row), in local indices, for each row of this rank in the boxes `parts`, which
// are in global indices.
template <class Use>
void each_row_of(const Fluid::State& s, std::span<const CellBox> parts, Use&& use) {
    for (const CellBox& part : parts) {
        const CellBox box = s.local_part(part);
        for (int z = box.lo[2]; z < box.hi[2]; ++z) {
            for (int y = box.lo[1]; y < box.hi[1]; ++y)
                use(CellRow{y, z, box.lo[0], box.hi[0]});
        }
    }
}

// Moments of a row, in local indices, with half of the body force added to the momentum
// of fluid cells, so that the velocity is that at the time of the step.
void moments_in_time(const Fluid::State& s, const CellRow& row, RowMoments& m);

// Number of cells of a row that lie in no obstacle. row: local indices.
inline double fluid_cells_of(const Fluid::State& s, const CellRow& row) {
    if (!s.obstacles) return row.size();
    double cells = 0;
    for (int x = row.x_begin; x < row.x_end; ++x)
        cells += s.is_solid({x, row.y, row.z}) ? 0 : 1;
    return cells;
}

}  // namespace magfsi::fluid
