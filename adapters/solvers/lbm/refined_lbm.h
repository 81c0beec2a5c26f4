// SPDX-License-Identifier: GPL-2.0-or-later
// The lattice-Boltzmann solver on a refined grid, as a FluidSolver.
#pragma once

#include <mpi.h>

#include "adapters/solvers/fluids/fluid_solver.h"
#include "fluid_lbm/refinement/refined_fluid.h"

namespace magfsi::lbm {

// Passes the participant's calls on to a fluid::RefinedFluid, which must outlive this
// object. Bodies meet the finest level only: grid() is that level's cells in the whole
// box, of which a rank owns those in the patches.
class RefinedLbm final : public fluids::FluidSolver {
  public:
    // renewal: the steps at which the patches may follow the bodies.
    RefinedLbm(MPI_Comm comm, fluid::RefinedFluid& fluid,
               const coupler::Renewal& renewal);

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
    // Moves the patches with the bodies, if need be. Throws coupler::Diverged if no
    // patches can be placed around the boxes.
    void follow(const std::vector<std::array<scene::Vec3, 2>>& bodies_m) override;

    std::string headline() const override;
    fluids::FluidTotals totals() override;
    double quantity(scene::FluidQuantity quantity) override;
    std::vector<scene::Vec3> obstacle_forces() override {
        return fluid_.obstacle_forces();
    }
    fluids::PlaneFlow plane_flow(int axis, double at_m) override {
        return fluid_.plane_flow(axis, at_m);
    }
    std::vector<fluids::FieldCells> field_cells() const override;
    void field(scene::FluidField field, std::size_t patch, std::span<float> out) override;
    void check_divergence() override;
    output::FluidSummary summary() const override;
    double waited_for_neighbours_s() const override {
        return fluid_.waited_for_neighbours_s();
    }
    void save(coupler::StateWriter* file) override;
    void restore(const coupler::StateReader& file) override;

  private:
    // A block of cells of one size: level 0, the coarsest, has one; every finer level has
    // one in each nest.
    struct Patch {
        int level = 0, nest = 0;
    };
    // All patches, level by level: their order is that of field_cells() and of files.
    std::vector<Patch> patches() const;

    MPI_Comm comm_;
    fluid::RefinedFluid& fluid_;
    coupler::Grid grid_;
};

}  // namespace magfsi::lbm
