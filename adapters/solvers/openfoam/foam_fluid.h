// SPDX-License-Identifier: GPL-2.0-or-later
// OpenFOAM as a fluid solver of a participant (fluids::FluidSolver documents the
// functions it overrides).
#pragma once

#include <mpi.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "adapters/solvers/fluids/fluid_solver.h"
#include "adapters/solvers/openfoam/case.h"
#include "adapters/solvers/openfoam/engine/engine.h"

namespace magfsi::openfoam {

// The coupling sees the uniform grid of to_grid(); on a graded mesh several of its cells
// share a cell of OpenFOAM.
class FoamFluid final : public fluids::FluidSolver {
  public:
    // Writes the case into case_folder, makes `comm` OpenFOAM's world and loads the
    // engine. finds_force: the force of a step is found with the pressure, in repeated
    // steps (forcing no_slip). Throws std::runtime_error if OpenFOAM is missing or
    // refuses the case. Collective over `comm`.
    FoamFluid(MPI_Comm comm, const scene::Fluid& fluid, const CaseTimes& times,
              const std::filesystem::path& case_folder, bool finds_force = false);
    FoamFluid(MPI_Comm comm, const scene::Fluid& fluid, double step_s,
              const std::filesystem::path& case_folder)
        : FoamFluid(comm, fluid, CaseTimes{.step_s = step_s}, case_folder) {}

    const coupler::Grid& grid() const override { return grid_; }
    void velocity(std::span<const coupler::GridRow> rows, std::span<double> out,
                  std::span<double> relative_density) override;
    void set_force(std::span<const coupler::GridRow> rows,
                   std::span<const double> density) override;
    void advance() override;
    void keep() override;
    void go_back() override;

    std::string headline() const override;
    fluids::FluidTotals totals() override;
    double quantity(scene::FluidQuantity quantity) override;
    std::vector<scene::Vec3> obstacle_forces() override;
    fluids::PlaneFlow plane_flow(int axis, double at_m) override;
    void field(scene::FluidField field, std::size_t level, std::span<float> out) override;
    void check_divergence() override;
    bool has_own_files() const override { return openfoam::has_own_files(fluid_); }
    void record(bool last) override { engine_->record(last); }
    output::FluidSummary summary() const override;
    output::Named<std::string> versions() const override;
    void save(coupler::StateWriter* file) override;
    void restore(const coupler::StateReader& file) override;

    // Starts from a flow that no scene can describe: velocity [m/s] as a function of the
    // place [m]. Must be called at time 0. Collective.
    using Flow = scene::Vec3 (*)(const scene::Vec3& position_m);
    void start_from(Flow flow);

  private:
    // Writes the inlets' velocities at this time into the engine.
    void set_inlets(double time_s);
    // Asks the engine for its momentum source, once.
    void begin_force();
    // Leaves the body force alone in all cells.
    void clear_force();
    scene::Vec3 everywhere() const;  // acceleration by the body force [m/s2]
    // Local number of the mesh cell that holds a cell of the uniform grid, or `solid`.
    static constexpr std::size_t solid = static_cast<std::size_t>(-1);
    std::size_t cell_at(int x, int y, int z) const;
    // Takes over the cells of a mesh with obstacles, which the engine has read.
    void take_cells();
    // Centre of a mesh cell of this rank [m].
    scene::Vec3 centre(std::size_t cell) const;

    MPI_Comm comm_;
    scene::Fluid fluid_;
    double step_s_;
    // Steps done since time 0, whose number gives the time.
    std::int64_t steps_ = 0;
    BoxMesh mesh_;
    std::array<int, 3> first_{}, cells_{};        // this rank's block of the mesh
    std::array<std::vector<int>, 3> cell_of_;     // mesh cell of each uniform cell
    std::array<std::vector<double>, 3> width_m_;  // widths of this rank's cells
    // With obstacles: centres of the cells [m], and the cell of each one of the uniform
    // grid, -1 for none.
    std::vector<std::array<double, 3>> centre_m_;
    std::vector<int> listed_cell_;
    coupler::Grid grid_;
    std::unique_ptr<Engine> engine_;
    double* acceleration_ = nullptr;   // the engine's; null before the first force
    std::vector<std::size_t> forced_;  // cells with a coupling force
    // An inlet's faces on this rank: velocity in the engine, and velocity over its mean.
    struct Inlet {
        int side;
        double* velocity;
        std::vector<double> shape;
    };
    std::vector<Inlet> inlets_;
    FlowState kept_;  // state that the implicit scheme goes back to
    std::int64_t kept_steps_ = 0;
    bool may_repeat_ = false;  // the coming step
    bool again_ = false;       // the coming advance repeats the last step
};

}  // namespace magfsi::openfoam
