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
#include "coupler/output/probe_file.h"
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
    // The columns of probes.csv and its last row, on the leading rank; null without
    // probes.
    const output::ProbeFile* probes = nullptr;
    // Where a controller sets the field: what it is now. Empty up to the first call.
    std::optional<structure::FieldProgram> steered{};
    std::optional<structure::Vec3> field_t(double time_s) const;
    std::function<void(coupler::StateWriter*)> save_control{};
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
// two coupled steps and on all ranks of the structure. The scene needs a magnetic_field.
void set_field(StructureRun& run, const structure::FieldProgram& law);

// An output of outputs.inc is an object of this type, called NAME_output.
using StructureOutput = coupler::OutputKind<StructureRun>;

// The structure's half of a checkpoint: nodes, what fixes keep, what markers carry.
// Collective; file is null but on the root.
void save_structure(const StructureRun& run, coupler::StateWriter* file);

// A text in a checkpoint, as numbers; empty where there is none.
void save_text(coupler::StateWriter& file, const std::string& table,
               const std::string& text);
std::string text_in(const coupler::StateReader& file, const std::string& table);

// The two halves of a restart, each collective: the bodies after engine.set_up and before
// markers are placed on ranks, the rest before the first exchange with the fluid. Throw
// coupler::StateFault when the file is of other meshes.
void restore_bodies(StructureRun& run, const coupler::StateReader& file);
void restore_coupling(const StructureRun& run, const coupler::StateReader& file);

}  // namespace magfsi::lammps
