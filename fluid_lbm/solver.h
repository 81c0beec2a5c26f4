// The lattice Boltzmann solver of one rank, in lattice units; fluid.h wraps it in SI.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fluid_lbm/boundary/boundaries.h"
#include "fluid_lbm/forcing/forced_rows.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/obstacle/obstacles.h"
#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/parallel/halo.h"
#include "fluid_lbm/parallel/row_boxes.h"
#include "fluid_lbm/sampling/macroscopic.h"
#include "fluid_lbm/streaming/kept_state.h"
#include "fluid_lbm/streaming/kernel_choice.h"
#include "fluid_lbm/streaming/unsound.h"

namespace magfsi::fluid {

struct SolverConfig {
    std::array<int, 3> cells{};
    std::array<bool, 3> periodic{};
    std::array<std::array<double, 3>, 6> wall_velocity{};  // x_min x_max y_min ...
    std::array<LatticeSide, 6> sides{};  // of axes that are not periodic
    Solids solids;                       // obstacles
    ObstacleWall obstacle_wall = ObstacleWall::interpolated;
    std::optional<std::array<double, 3>> body_force;
    CollisionParameters collision;
    AnyKernels kernels;  // decide what populations are stored as
};

struct Unsound {
    UnsoundCell cell;       // indices within the rank
    std::int64_t step = 0;  // steps done before the one that found it
};

class Solver {
  public:
    // At rest. comm must outlive the object.
    Solver(MPI_Comm comm, const SolverConfig& config);

    const Decomposition& decomposition() const { return decomposition_; }
    const CellBox& owned() const { return decomposition_.boxes[rank_]; }
    const RowLayout& layout() const { return layout_; }
    int rank() const { return rank_; }

    // The state before collision, complete between steps whatever its arrangement: ghost
    // rows filled, walls applied.
    View view() const { return {populations_, layout_, arrangement_, kernels_}; }
    Arrangement arrangement() const { return arrangement_; }
    const Populations& populations() const { return populations_; }

    // Of the next step only. There is room for them once somebody asks.
    ForcedRows& forces() {
        if (!forces_) make_forces({});
        return *forces_;
    }
    std::size_t force_bytes() const { return forces_ ? forces_->bytes() : 0; }

    // Sides with free slip, an inlet or an outlet.
    const std::array<bool, 6>& open_sides() const { return open_sides_; }
    // Null without obstacles.
    const Obstacles* obstacles() const { return obstacles_ ? &*obstacles_ : nullptr; }
    // Local indices.
    bool is_solid(const std::array<int, 3>& cell) const {
        return obstacles_ && obstacles_->map().solid(cell);
    }
    // visit(x, y, z) for all cells outside obstacles, in the order in which they are
    // stored; without obstacles none is looked at for one.
    template <class Visit>
    void each_fluid_cell(Visit&& visit) const {
        if (obstacles_)
            each_cell([&](int x, int y, int z) {
                if (!obstacles_->map().solid({x, y, z})) visit(x, y, z);
            });
        else
            each_cell(visit);
    }
    // After the populations have been set from outside: solid cells back to rest.
    void settle_obstacles();

    // Collective.
    void step();
    std::int64_t steps_done() const { return steps_done_; }
    double waited_for_neighbors_s() const { return halo_.waited_s(); }
    // For a state that is put back: the arrangement that it had goes with the step. The
    // populations must be set next.
    void set_steps_done(std::int64_t steps) {
        steps_done_ = steps;
        arrangement_ = steps % 2 == 0 ? Arrangement::natural : Arrangement::swapped;
    }

    // For steps that are taken again (fluid.h).
    void keep();
    void go_back();
    std::size_t kept_bytes() const { return kept_ ? kept_->bytes() : 0; }

    // The first cell of this rank that a step found no longer sound, lattice units; found
    // in passing by the step whose collision acts on it.
    const std::optional<Unsound>& unsound() const { return unsound_; }

  private:
    template <class Visit>
    void each_cell(const Visit& visit) const {
        for (int z = 0; z < layout_.nz; ++z) {
            for (int y = 0; y < layout_.ny; ++y) {
                for (int x = 0; x < layout_.nx; ++x) visit(x, y, z);
            }
        }
    }
    void make_forces(const std::optional<std::array<double, 3>>& body_force);
    void sweep_boxes(std::span<const RowBox> boxes);
    void sweep_and_exchange(Exchange exchange);
    void apply_boundaries();

    Decomposition decomposition_;
    int rank_;
    RowLayout layout_;
    Populations populations_;
    std::unique_ptr<ForcedRows> forces_;  // null where nothing pushes the fluid
    Halo halo_;
    std::vector<RowBox> rows_at_cuts_, inner_rows_;
    std::optional<Obstacles> obstacles_;
    Boundaries boundaries_;
    std::array<bool, 6> open_sides_{};
    AnyKernels kernels_;
    CollisionParameters collision_;
    Arrangement arrangement_ = Arrangement::natural;
    std::int64_t steps_done_ = 0;
    std::optional<Unsound> unsound_;
    bool sweep_is_all_;
    std::unique_ptr<KeptState> kept_;  // only where steps are taken again
    bool again_ = false;               // the coming step is one that is taken again
};

}  // namespace magfsi::fluid
