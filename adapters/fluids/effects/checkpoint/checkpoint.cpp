#include "adapters/fluids/fluid_run.h"
#include "coupler/checkpoint/checkpoints.h"

namespace magfsi::fluids {

extern const FluidOutput checkpoint_output{
    "checkpoint", "checkpoint", [](FluidRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.checkpoint) return nullptr;
        return std::make_unique<coupler::Checkpoints>(
            run.session,
            [&run](coupler::StateWriter* file) { run.fluid.save(run.balance, file); });
    }};

}  // namespace magfsi::fluids
