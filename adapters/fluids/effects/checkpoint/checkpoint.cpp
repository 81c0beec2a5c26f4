#include "adapters/fluids/fluid_run.h"
#include "coupler/checkpoint/checkpoints.h"

namespace magfsi::fluids {

namespace {

class Checkpoint : public coupler::Output {
  public:
    explicit Checkpoint(FluidRun& run)
        : checkpoints_(run.session, [&run](coupler::StateWriter* file) {
              run.fluid.save(run.balance, file);
          }) {}
    void end_step() override { checkpoints_.end_step(); }
    void finish() override { checkpoints_.finish(); }

  private:
    coupler::Checkpoints checkpoints_;
};

}  // namespace

extern const FluidOutput checkpoint_output{
    "checkpoint", "checkpoint", [](FluidRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.session.scene().checkpoint) return nullptr;
        return std::make_unique<Checkpoint>(run);
    }};

}  // namespace magfsi::fluids
