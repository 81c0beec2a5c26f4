// SPDX-License-Identifier: GPL-2.0-or-later
// Files that a solver writes in a format of its own (fluid.openfoam: time folders and
// function objects).
#include <memory>

#include "adapters/solvers/fluids/fluid_run.h"

namespace magfsi::fluids {

namespace {

class OwnFiles : public coupler::Output {
  public:
    explicit OwnFiles(FluidRun& run) : session_(run.session), fluid_(run.fluid) {}
    void end_step() override { fluid_.record(!session_.running()); }

  private:
    const coupler::Session& session_;
    FluidSolver& fluid_;
};

}  // namespace

extern const FluidOutput own_files_output{
    "own_files", "write own files",
    [](FluidRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.fluid.has_own_files()) return nullptr;
        return std::make_unique<OwnFiles>(run);
    }};

}  // namespace magfsi::fluids
