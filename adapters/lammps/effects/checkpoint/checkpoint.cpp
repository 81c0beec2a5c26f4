#include "adapters/lammps/structure_run.h"
#include "coupler/checkpoint/checkpoints.h"

namespace magfsi::lammps {

namespace {

class Checkpoint : public coupler::Output {
  public:
    explicit Checkpoint(StructureRun& run)
        : checkpoints_(run.session, [&run](coupler::StateWriter* file) {
              save_structure(run.state(), file);
          }) {}
    void end_step() override { checkpoints_.end_step(); }
    void finish() override { checkpoints_.finish(); }

  private:
    coupler::Checkpoints checkpoints_;
};

}  // namespace

extern const StructureOutput checkpoint_output{
    "checkpoint", "checkpoint",
    [](StructureRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene().checkpoint) return nullptr;
        return std::make_unique<Checkpoint>(run);
    }};

}  // namespace magfsi::lammps
