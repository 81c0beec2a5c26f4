// fluid.pvd and its files: one .vti a rank, one .pvti an instant.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "coupler/output/pvd.h"
#include "coupler/output/vti.h"
#include "coupler/scene/scene.h"
#include "coupler/step/clock.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

class FluidFiles {
  public:
    FluidFiles(MPI_Comm comm, const fluid::Fluid& fluid, const scene::FluidOutput& wanted,
               const std::filesystem::path& run_folder);

    // After a restart: the series again up to the clock's step, one file every so many.
    void resume(const coupler::Clock& clock, std::int64_t every);

    // Collective. index numbers the files.
    void write(std::int64_t index, double time_s);

  private:
    bool wants(scene::FluidField field) const;
    void write_index(std::int64_t index, double time_s);
    std::filesystem::path whole(std::int64_t index) const;
    std::filesystem::path piece(std::int64_t index, int rank) const;

    MPI_Comm comm_;
    int rank_ = 0;
    const fluid::Fluid& fluid_;
    std::vector<scene::FluidField> fields_;
    std::filesystem::path folder_;
    output::ImageGrid grid_;
    std::vector<output::CellExtent> extents_;
    std::unique_ptr<output::PvdSeries> series_;  // on the root
    std::vector<float> velocity_, density_, vorticity_;
};

}  // namespace magfsi::lbm
