#include "fluid_lbm/solver.h"

#include "fluid_lbm/streaming/sweep.h"

namespace magfsi::fluid {

namespace {

int comm_rank(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

int comm_size(MPI_Comm comm) {
    int size = 1;
    MPI_Comm_size(comm, &size);
    return size;
}

Storage storage(const AnyKernels& kernels) {
    return std::holds_alternative<ChosenKernels<float>>(kernels) ? Storage::float_
                                                                 : Storage::double_;
}

// Those that move and that this rank's box touches.
std::vector<MovingWall> moving_walls(const SolverConfig& config, const CellBox& box) {
    std::vector<MovingWall> walls;
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            const auto& velocity = config.wall_velocity[2 * axis + side];
            const bool here =
                side == 0 ? box.lo[axis] == 0 : box.hi[axis] == config.cells[axis];
            if (!here || velocity == std::array<double, 3>{}) continue;
            walls.push_back({axis, side, velocity});
        }
    }
    return walls;
}

}  // namespace

Solver::Solver(MPI_Comm comm, const SolverConfig& config)
    : decomposition_(decompose(config.cells, config.periodic, comm_size(comm))),
      rank_(comm_rank(comm)),
      layout_(decomposition_.layout(rank_)),
      populations_(layout_.nx, layout_.row_count(), storage(config.kernels)),
      forces_(layout_.nx, layout_.ny, layout_.nz, config.body_force),
      halo_(comm, decomposition_, rank_),
      moving_walls_(moving_walls(config, decomposition_.boxes[rank_])),
      kernels_(config.kernels),
      collision_(config.collision) {}

void Solver::step() {
    sweep(populations_, layout_, arrangement_, forces_, kernels_, collision_);
    if (arrangement_ == Arrangement::natural) {
        halo_.fill(populations_);
        arrangement_ = Arrangement::swapped;
    } else {
        halo_.give_back(populations_);
        arrangement_ = Arrangement::natural;
    }
    move_walls(populations_, layout_, moving_walls_);
    forces_.clear();
}

}  // namespace magfsi::fluid
