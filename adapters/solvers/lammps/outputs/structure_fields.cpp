// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/structure_files.h"
#include "adapters/solvers/lammps/structure_run.h"

namespace magfsi::lammps {

namespace {

// Writes structure.pvd and its files at the intervals of output.structure.
class StructureFields : public coupler::Output {
  public:
    explicit StructureFields(StructureRun& run)
        : run_(run),
          every_(run.session.clock().every(run.scene.output.structure->every_s)) {
        if (!run.session.world().root()) return;
        files_ = std::make_unique<bodies::StructureFiles>(run.scene, run.input.bodies,
                                                          run.start, run.session.out());
        if (run.session.restart()) files_->resume(run.session.clock(), every_);
    }
    void begin() override {
        if (!run_.session.restart()) write();
    }
    void end_step() override {
        if (run_.session.clock().step() % every_ == 0) write();
    }

  private:
    // Writes a file of the present state. Collective; only the root writes.
    void write() {
        const NodalState nodes = run_.gather();
        const coupler::Clock& clock = run_.session.clock();
        if (files_)
            files_->write(clock.step() / every_, clock.time_s(), nodes,
                          run_.field_t(clock.time_s()));
    }

    StructureRun& run_;
    std::int64_t every_;
    std::unique_ptr<bodies::StructureFiles> files_;
};

}  // namespace

extern const StructureOutput structure_fields_output{
    "structure_fields", "write fields",
    [](StructureRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.output.structure) return nullptr;
        return std::make_unique<StructureFields>(run);
    }};

}  // namespace magfsi::lammps
