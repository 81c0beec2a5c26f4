// SPDX-License-Identifier: GPL-2.0-or-later
// One rank's fluid in lattice units: for the files that implement Fluid (fluid.cpp,
// step.cpp, sampling/).
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

// A communicator of the fluid's own: its messages cannot meet those of its user.
struct OwnedComm {
    explicit OwnedComm(MPI_Comm parent);
    ~OwnedComm();
    OwnedComm(const OwnedComm&) = delete;
    OwnedComm& operator=(const OwnedComm&) = delete;
    operator MPI_Comm() const { return comm; }

    MPI_Comm comm = MPI_COMM_NULL;
    int rank = 0, size = 1;
};

struct Fluid::State {
    // In the configured flow.
    State(MPI_Comm parent, const FluidConfig& fluid_config);

    const FluidConfig config;
    const Units unit;
    const std::vector<double> rate_table;  // of a rheology
    const CollisionParameters parameters;
    const AnyKernels kernels;  // decide what populations are stored as
    const OwnedComm comm;
    const Decomposition decomposition;
    const RowLayout layout;
    Populations populations;
    Arrangement arrangement = Arrangement::natural;
    std::int64_t steps_done = 0;
    Halo halo;
    // What steps from an arrangement need: natural ones all, the others nothing of an
    // outer layer that is filled anew after them.
    struct Needed {
        std::vector<RowBox> at_cuts, inner;
        bool x_ends = true;
    };
    const Needed needed_from_natural, needed_from_swapped;
    const Needed& needed() const {
        return arrangement == Arrangement::natural ? needed_from_natural
                                                   : needed_from_swapped;
    }
    std::optional<ForcedRows> forces;    // of the next step; empty until one is set
    std::optional<Obstacles> obstacles;  // empty without any
    std::vector<std::unique_ptr<SideEffect>> side_effects;
    // The first cell that a step found invalid, and the steps done before that one.
    std::optional<InvalidCell> invalid;
    std::int64_t invalid_step = 0;
    std::optional<KeptState> kept;  // only where steps are taken again
    bool again = false;             // the coming step is one that is taken again

    const CellBox& owned() const { return decomposition.boxes[comm.rank]; }
    // The state before collision, complete between steps whatever its arrangement: ghost
    // rows filled, walls applied.
    View view() const { return {populations, layout, arrangement, kernels}; }
    std::size_t cells() const {  // of this rank
        return static_cast<std::size_t>(layout.nx) * layout.ny * layout.nz;
    }
    // Local indices.
    bool is_solid(const Cell& cell) const {
        return obstacles && obstacles->map().solid(cell);
    }
    // Box of global indices, as far as it is this rank's, in local ones.
    CellBox local_part(const CellBox& box) const;
    void need_forces(const std::optional<Vec3>& body_force);
    void set_initial_flow();
    // After the populations have been changed: solid cells back to rest.
    void reset_solid_cells();
};

// use(row), local indices, for each of this rank's rows of boxes of global indices.
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

// Without solid cells; row: local indices.
inline double fluid_cells_of(const Fluid::State& s, const CellRow& row) {
    if (!s.obstacles) return row.size();
    double cells = 0;
    for (int x = row.x_begin; x < row.x_end; ++x)
        cells += s.is_solid({x, row.y, row.z}) ? 0 : 1;
    return cells;
}

}  // namespace magfsi::fluid
