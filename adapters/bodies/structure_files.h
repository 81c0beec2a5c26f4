// structure.pvd and its .vtu files: displacement, velocity, magnetisation.
#pragma once

#include <filesystem>
#include <vector>

#include "adapters/bodies/nodal_state.h"
#include "coupler/output/vtk.h"
#include "coupler/step/clock.h"
#include "structure/body.h"

namespace magfsi::bodies {

// On the structure's root only.
class StructureFiles {
  public:
    StructureFiles(const std::vector<structure::Body>& bodies, const NodalState& start,
                   const std::filesystem::path& run_folder);

    // After a restart: the series again up to the clock's step, one file every so many.
    void resume(const coupler::Clock& clock, std::int64_t every);

    void write(std::int64_t index, double time_s, const NodalState& state);

  private:
    std::filesystem::path file(std::int64_t index) const;

    std::vector<std::array<int, 8>> elements_;  // of all bodies, global node numbers
    std::vector<double> magnetization_;         // three values an element
    std::vector<float> body_;                   // number of the body, one an element
    std::vector<Vec3> start_m_;
    std::filesystem::path folder_;
    output::PvdSeries series_;
};

}  // namespace magfsi::bodies
