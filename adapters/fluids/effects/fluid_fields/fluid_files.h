// fluid.pvd and its files: one .vti a rank, one .pvti an instant.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "adapters/fluids/fluid_solver.h"
#include "coupler/output/vtk.h"
#include "coupler/participants/world.h"
#include "adapters/scene/scene.h"
#include "coupler/step/clock.h"

namespace magfsi::fluids {

class FluidFiles {
  public:
    FluidFiles(const coupler::World& world, FluidSolver& fluid,
               const scene::FluidOutput& wanted, const std::filesystem::path& run_folder);

    // After a restart: the series again up to the clock's step, one file every so many.
    void resume(const coupler::Clock& clock, std::int64_t every);

    // Collective. index numbers the files.
    void write(std::int64_t index, double time_s);

  private:
    void write_index(std::int64_t index, double time_s);
    std::filesystem::path whole(std::int64_t index) const;
    std::filesystem::path piece(std::int64_t index, int rank) const;

    MPI_Comm comm_;
    int rank_ = 0;
    FluidSolver& fluid_;
    std::vector<scene::FluidField> fields_;
    std::filesystem::path folder_;
    output::ImageGrid grid_;
    std::vector<output::CellExtent> extents_;
    std::unique_ptr<output::PvdSeries> series_;  // on the root
};

}  // namespace magfsi::fluids
