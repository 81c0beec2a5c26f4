// SPDX-License-Identifier: GPL-2.0-or-later
// The state of a run of the structure in LAMMPS that its participant, outputs and
// checkpoint share.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/solvers/bodies/field_work.h"
#include "adapters/solvers/bodies/rigid_parts.h"
#include "adapters/solvers/lammps/energy_audit.h"
#include "adapters/solvers/lammps/engine.h"
#include "adapters/solvers/lammps/substeps.h"
#include "coupler/checkpoint/state_file.h"
#include "coupler/output/probe_file.h"
#include "coupler/scheme/structure_coupling.h"
#include "coupler/step/task_list.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

// Sums of the fluid's force since the last row of probes.csv, for probes.mean_forces: the
// impulses [N s] of the bodies, then of their parts, and the time [s].
struct ForceSums {
    std::vector<structure::Vec3> impulse_n_s{};
    double time_s = 0;
};

struct StructureRun {
    const scene::Scene& scene;
    coupler::Session& session;
    Substeps substeps{};  // the steps of the last coupled step
    StepCount counted{};
    structure::LammpsInput input{};
    std::vector<std::string> fix_ids{};  // ID of the fix magttice of each body
    int atoms = 0;                       // number of the nodes of all bodies
    std::unique_ptr<Engine> engine{};
    // The coupling to the fluid; null without one.
    std::unique_ptr<coupler::StructureCoupling> coupling{};
    // The energy audit; null without probes.energy_audit.
    std::unique_ptr<EnergyAudit> audit{};

    // The nodes at step 0, on the root; valid only while the outputs are made.
    NodalState start{};
    // Mass of each node of the bodies themselves, the enclosed fluid not subtracted; on
    // the root, with a fluid.
    std::vector<double> whole_mass_kg{};
    // What the rigid parts have beyond their nodes, with whole masses; on the root.
    bodies::RigidKinetics rigid{};
    // The field's work on each body; on the root, on a path of equilibria in a field.
    std::vector<bodies::FieldWork> field_work{};
    // The file probes.csv with its columns and its last row; on the leading rank, null
    // without probes.
    const output::ProbeFile* probes = nullptr;
    ForceSums force_sums{};
    // The uniform field that a controller has set; empty before its first call and
    // without a controller.
    std::optional<structure::FieldProgram> steered{};
    // Value of that field [T]; empty where the scene's law holds.
    std::optional<structure::Vec3> field_t(double time_s) const;
    // Writes the controller's part of a checkpoint; empty without a controller.
    // Collective; the file is null on ranks other than the root.
    std::function<void(coupler::StateWriter*)> save_control{};

    // The record of momentum and power at the interface; null unless the run measures it.
    coupler::BalanceRecord* balance() const {
        return coupling ? coupling->balance() : nullptr;
    }
    // All nodes on the root, with whole masses; empty on other ranks. Collective.
    NodalState gather() const { return with_whole_masses(engine->gather(atoms)); }
    NodalState with_whole_masses(NodalState nodes) const {
        if (!whole_mass_kg.empty()) nodes.mass_kg = whole_mass_kg;
        return nodes;
    }
};

// Replaces the law of the uniform field from the present time on. For controllers: to be
// called between two coupled steps, on all ranks of the structure. The scene must have a
// magnetic_field.
void set_field(StructureRun& run, const structure::FieldProgram& law);

// An output of outputs.inc is an object of this type, called NAME_output.
using StructureOutput = coupler::OutputKind<StructureRun>;

// Writes the structure's half of a checkpoint: nodes, state of the fixes, arrays of the
// markers. Collective; file is null on ranks other than the root.
void save_structure(const StructureRun& run, coupler::StateWriter* file);

// Writes a text into a checkpoint as a table of character codes; an empty text gets no
// table. text_in reads it back, empty if there is no such table.
void save_text(coupler::StateWriter& file, const std::string& table,
               const std::string& text);
std::string text_in(const coupler::StateReader& file, const std::string& table);

// The two halves of a restart, both collective. restore_bodies comes after engine.set_up
// and before markers are assigned to ranks, restore_coupling before the first exchange
// with the fluid. Both throw coupler::StateFault if the file is one of other meshes.
void restore_bodies(StructureRun& run, const coupler::StateReader& file);
void restore_coupling(const StructureRun& run, const coupler::StateReader& file);

}  // namespace magfsi::lammps
