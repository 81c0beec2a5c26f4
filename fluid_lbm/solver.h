// The lattice Boltzmann solver of one rank, in lattice units; fluid.h wraps it in SI.
#pragma once

#include <mpi.h>

#include <array>
#include <optional>
#include <vector>

#include "fluid_lbm/boundary/moving_wall.h"
#include "fluid_lbm/forcing/forced_rows.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/parallel/halo.h"
#include "fluid_lbm/sampling/macroscopic.h"
#include "fluid_lbm/streaming/kernel_choice.h"

namespace magfsi::fluid {

struct SolverConfig {
    std::array<int, 3> cells{};
    std::array<bool, 3> periodic{};
    std::array<std::array<double, 3>, 6> wall_velocity{};  // x_min x_max y_min ...
    std::optional<std::array<double, 3>> body_force;
    CollisionParameters collision;
    AnyKernels kernels;  // decide what populations are stored as
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

    // Of the next step only.
    ForcedRows& forces() { return forces_; }
    const ForcedRows& forces() const { return forces_; }

    // Collective.
    void step();

  private:
    Decomposition decomposition_;
    int rank_;
    RowLayout layout_;
    Populations populations_;
    ForcedRows forces_;
    Halo halo_;
    std::vector<MovingWall> moving_walls_;
    AnyKernels kernels_;
    CollisionParameters collision_;
    Arrangement arrangement_ = Arrangement::natural;
};

}  // namespace magfsi::fluid
