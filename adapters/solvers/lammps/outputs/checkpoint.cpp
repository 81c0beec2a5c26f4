// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/structure_run.h"
#include "coupler/checkpoint/checkpoints.h"

namespace magfsi::lammps {

// The structure's half of the checkpoints that the scene asks for.
extern const StructureOutput checkpoint_output{
    "checkpoint", "checkpoint",
    [](StructureRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.checkpoint) return nullptr;
        return std::make_unique<coupler::Checkpoints>(
            run.session,
            [&run](coupler::StateWriter* file) { save_structure(run, file); });
    }};

}  // namespace magfsi::lammps
