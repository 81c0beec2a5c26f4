// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/fluids/fluid_run.h"
#include "coupler/checkpoint/checkpoints.h"
#include "coupler/checkpoint/rank_rows.h"

namespace magfsi::fluids {

namespace {

// Saves the solver's state and, if the interface is audited, the sums of the steps since
// the last probe row, by rank.
void save(FluidRun& run, coupler::StateWriter* file) {
    run.fluid.save(file);
    if (!run.balance) return;
    const auto mine = run.balance->values();
    const auto all = coupler::gather_shares(run.session.world().local(), mine);
    if (file && !mine.empty())
        file->table("balance", all, {all.size() / mine.size(), mine.size()});
}

}  // namespace

extern const FluidOutput checkpoint_output{
    "checkpoint", "checkpoint", [](FluidRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.checkpoint) return nullptr;
        return std::make_unique<coupler::Checkpoints>(
            run.session, [&run](coupler::StateWriter* file) { save(run, file); });
    }};

}  // namespace magfsi::fluids
