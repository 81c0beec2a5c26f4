// What the structure's outputs are made from.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "adapters/lammps/structure_state.h"
#include "coupler/step/task_list.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

struct StructureRun {
    const scene::Scene& scene;
    coupler::Session& session;
    Engine& engine;
    const structure::LammpsInput& input;
    const std::vector<std::string>& fix_ids;  // of each body's fix magttice
    int atoms = 0;
    NodalState start{};  // step 0, on the root; only while outputs are made
    // With a fluid, on the root: the bodies' whole masses, whatever came off their nodes.
    std::vector<double> whole_mass_kg{};
    bool recorded = false;  // --record

    // Null when the scene has none.
    BodyCoupling* coupling = nullptr;
    coupler::BalanceRecord* balance = nullptr;
    EnergyAudit* audit = nullptr;

    std::function<StructureParts()> state{};  // for a checkpoint, of the present step
    // What the fluid has sent for a row of probes, on the root. Empty: nobody listens.
    std::function<void(std::span<const double>)> heard{};

    NodalState gather() const;  // with whole masses; collective
};

// An output of effects.inc is an object of this type, called NAME_output.
using StructureOutput = coupler::OutputKind<StructureRun>;

// Those of this build, up to one without a name.
const StructureOutput* structure_outputs();

}  // namespace magfsi::lammps
