// The velocity of a rank's cells with one layer of its neighbours', for derivatives.
#pragma once

#include <mpi.h>

#include <array>
#include <cstddef>
#include <vector>

#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/solver.h"

namespace magfsi::fluid {

class VelocityField {
  public:
    // open: sides (x_min x_max ...) where the velocity is not the wall's.
    explicit VelocityField(const RowLayout& layout, const std::array<bool, 6>& open = {});

    // y and z from -1 to ny and nz.
    double* at(int x, int y, int z) { return values_.data() + offset(x, y, z); }
    const double* at(int x, int y, int z) const {
        return values_.data() + offset(x, y, z);
    }

    // Fills the layers beyond cut sides. Collective among neighbours.
    void exchange(MPI_Comm comm, const Decomposition& decomposition, int rank);

    // curl u in a cell, central differences; at walls, whose velocity is given by side
    // (x_min x_max y_min ...), the second-order one-sided difference through the wall
    // half a cell away; at open sides as if the velocity did not change across them.
    // Unit: velocity unit over cells.
    std::array<double, 3> curl(
        int x, int y, int z,
        const std::array<std::array<double, 3>, 6>& wall_velocity) const;

    // |curl u|^2 / 2 of a cell. Unit: velocity unit over cells, squared.
    double enstrophy(int x, int y, int z,
                     const std::array<std::array<double, 3>, 6>& wall_velocity) const;

    // Its sum over the cells of a row, none of them solid.
    double enstrophy_of_row(
        int y, int z, const std::array<std::array<double, 3>, 6>& wall_velocity) const;

  private:
    std::size_t offset(int x, int y, int z) const;
    std::array<double, 3> derivative(
        const std::array<int, 3>& cell, int axis,
        const std::array<std::array<double, 3>, 6>& wall_velocity) const;

    RowLayout layout_;
    std::array<bool, 6> open_;
    std::vector<double> values_;
};

// The solver's present velocity, exchanged, lattice units. Collective among neighbours.
VelocityField sample_velocity(MPI_Comm comm, const Solver& solver);

}  // namespace magfsi::fluid
