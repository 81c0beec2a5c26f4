// The structure's half of a checkpoint: nodes, what fixes keep, what markers carry.
#pragma once

#include "adapters/lammps/audit/energy_audit.h"
#include "adapters/lammps/body_coupling.h"
#include "adapters/lammps/engine.h"
#include "adapters/lammps/substeps.h"
#include "coupler/checkpoint/state_file.h"
#include "coupler/immersed_boundary/balance.h"

namespace magfsi::lammps {

struct StructureParts {
    const scene::Scene& scene;
    const coupler::Session& session;
    Engine& engine;
    int atoms = 0;
    // Null when the scene has none.
    BodyCoupling* coupling = nullptr;
    coupler::BalanceRecord* balance = nullptr;
    EnergyAudit* audit = nullptr;
    int substeps = 1;                    // of the last coupled step
    const StepCount* counted = nullptr;  // only to save
};

// Collective; file is null but on the root. Contact's lists of neighbours are renewed, as
// they will be in a run that goes on from here, so that both add forces in one order.
void save_structure(const StructureParts& parts, coupler::StateWriter* file);

// The two halves of a restart, each collective: the bodies after engine.set_up and before
// markers look for their places, the rest before the first exchange with the fluid. Throw
// coupler::StateFault when the file is of other meshes.
void restore_bodies(const StructureParts& parts, const coupler::StateReader& file);
void restore_coupling(const StructureParts& parts, const coupler::StateReader& file);

}  // namespace magfsi::lammps
