// SPDX-License-Identifier: GPL-2.0-or-later
// The lattice-Boltzmann solver on one uniform grid, as a FluidSolver.
#pragma once

#include <mpi.h>

#include <vector>

#include "adapters/solvers/fluids/fluid_solver.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

// Fills `out` with a field at this rank's cells, x fastest; 3 consecutive values per cell
// for vectors. Collective.
void sample(const fluid::Fluid& fluid, scene::FluidField field, std::span<float> out);

// Passes the participant's calls on to a fluid::Fluid, which must outlive this object.
// The units of the interface are SI.
class LbmFluid final : public fluids::FluidSolver {
  public:
    // comm: the communicator of the fluid's ranks.
    LbmFluid(MPI_Comm comm, fluid::Fluid& fluid);

    const coupler::Grid& grid() const override { return grid_; }
    void velocity(std::span<const CellRow> rows, std::span<double> out,
                  std::span<double> relative_density) override {
        fluid_.velocity(rows, out, relative_density);
    }
    void set_force(std::span<const CellRow> rows,
                   std::span<const double> density) override {
        fluid_.set_force(rows, density);
    }
    void advance() override { fluid_.step(); }
    void keep() override { fluid_.keep(); }
    void go_back() override { fluid_.go_back(); }

    std::string headline() const override;
    fluids::FluidTotals totals() override { return fluid_.totals(); }
    double quantity(scene::FluidQuantity quantity) override;
    std::vector<scene::Vec3> obstacle_forces() override {
        return fluid_.obstacle_forces();
    }
    fluids::PlaneFlow plane_flow(int axis, double at_m) override {
        return fluid_.plane_flow(axis, at_m);
    }
    void field(scene::FluidField field, std::size_t level, std::span<float> out) override;
    void check_divergence() override;
    output::FluidSummary summary() const override;
    double waited_for_neighbours_s() const override {
        return fluid_.waited_for_neighbours_s();
    }
    void save(coupler::StateWriter* file) override;
    void restore(const coupler::StateReader& file) override;

  private:
    MPI_Comm comm_;
    fluid::Fluid& fluid_;
    coupler::Grid grid_;
};

}  // namespace magfsi::lbm
