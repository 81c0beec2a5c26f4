// SPDX-License-Identifier: GPL-2.0-or-later
// A run of the structure in LAMMPS: what its participant, outputs and checkpoint share.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adapters/bodies/field_work.h"
#include "adapters/lammps/energy_audit.h"
#include "adapters/lammps/engine.h"
#include "adapters/lammps/substeps.h"
#include "coupler/checkpoint/state_file.h"
#include "coupler/scheme/structure_coupling.h"
#include "coupler/step/task_list.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

struct StructureRun {
    const scene::Scene& scene;
    coupler::Session& session;
    Substeps substeps;  // of the last coupled step
    StepCount counted{};
    structure::LammpsInput input{};
    std::vector<std::string> fix_ids{};  // of each body's fix magttice
    int atoms = 0;
    std::unique_ptr<Engine> engine{};
    // Null when the scene has none.
    std::unique_ptr<coupler::StructureCoupling> coupling{};
    std::unique_ptr<EnergyAudit> audit{};

    NodalState start{};  // step 0, on the root; only while outputs are made
    // With a fluid, on the root: the bodies' whole masses, whatever came off their nodes.
    std::vector<double> whole_mass_kg{};
    // On a path of equilibria in a field, on the root: of each body.
    std::vector<bodies::FieldWork> field_work{};
    bool recorded = false;  // --record
    // By set_field; the scene's law where it is absent.
    std::optional<structure::Vec3> field_t{};
    // Called with what the fluid has sent for a row of probes, on the root; may be empty.
    std::function<void(std::span<const double>)> on_fluid_values{};

    coupler::BalanceRecord* balance() const {
        return coupling ? coupling->balance() : nullptr;
    }
    NodalState gather() const {  // with whole masses; collective
        NodalState nodes = engine->gather(atoms);
        if (!whole_mass_kg.empty()) nodes.mass_kg = whole_mass_kg;
        return nodes;
    }
};

// The applied field from here on, in place of the scene's law: for a controller, between
// two coupled steps and on all ranks of the structure. The scene needs a magnetic_field;
// throws std::logic_error without one. A run that goes on from a checkpoint starts with
// the law of the scene: set it again.
void set_field(StructureRun& run, const structure::Vec3& field_t);

// An output of outputs.inc is an object of this type, called NAME_output.
using StructureOutput = coupler::OutputKind<StructureRun>;

// The structure's half of a checkpoint: nodes, what fixes keep, what markers carry.
// Collective; file is null but on the root.
void save_structure(const StructureRun& run, coupler::StateWriter* file);

// The two halves of a restart, each collective: the bodies after engine.set_up and before
// markers are placed on ranks, the rest before the first exchange with the fluid. Throw
// coupler::StateFault when the file is of other meshes.
void restore_bodies(const StructureRun& run, const coupler::StateReader& file);
void restore_coupling(const StructureRun& run, const coupler::StateReader& file);

}  // namespace magfsi::lammps
