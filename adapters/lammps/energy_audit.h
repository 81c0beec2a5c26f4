// SPDX-License-Identifier: GPL-2.0-or-later
// The energy of all bodies and what became of it, since the start (docs/energy_audit.md).
// Exists only with probes.energy_audit.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adapters/bodies/nodal_state.h"
#include "adapters/scene/scene.h"
#include "coupler/output/summary.h"

namespace magfsi::lammps {

using bodies::NodalState;
using bodies::Vec3;

// The last two of the fluid's columns.
struct FluidEnergy {
    double sound = 0, kinetic = 0;
    double sum() const { return sound + kinetic; }
};

// What the solvers know at one time, of all bodies [J]. Sums are since the start.
struct EnergyTerms {
    double elastic = 0, platform = 0, contact = 0, dipoles = 0;  // stored
    double work_field = 0;
    double of_moved = 0;  // of nodes in prescribed motion: kinetic less the work on them
    double lost_viscosity = 0, lost_drag = 0, lost_friction = 0;
    double by_fluid = 0, by_enclosed = 0;  // work on the body at the markers
    FluidEnergy fluid;
    double for_nothing = 0;  // work on it at the markers that no body paid for
};

struct StructureRun;
// Puts the sums that the audit needs into LAMMPS's steps; after all commands of the
// script.
void attach_audit(const StructureRun& run);
// All but the fluid's own. Collective.
EnergyTerms collect_terms(const StructureRun& run);

class EnergyAudit {
  public:
    // start: step 0, with the masses that the nodes have. Both only matter on the root.
    EnergyAudit(const scene::Scene& scene, NodalState start);

    // Of an effect that the scene has not there is no column.
    std::vector<std::string> columns() const;

    // state: as start. The first row is that of the start.
    std::vector<double> row(const NodalState& state, const EnergyTerms& terms);

    output::EnergySummary summary() const;

    // Empty, or what is wrong at the last row: bodies and fluid have more energy than at
    // the start and all works together, by far more than steps and sound can make of it.
    std::string fault() const;

    // What the rows to come need of those before, for checkpoints.
    std::vector<double> carried() const;
    void set(std::span<const double> carried);

  private:
    struct Motion {
        double kinetic_whole = 0, kinetic = 0, kinetic_nodes = 0;
        double work_weight = 0, work_weight_nodes = 0;
    };
    struct Column {
        std::string name;
        double value = 0;
    };
    Motion motion_of(const NodalState& state) const;
    std::vector<Column> balance(const Motion& motion, const EnergyTerms& terms) const;
    void note(const Motion& motion, const EnergyTerms& terms, double residual);
    double stored(const EnergyTerms& terms) const;
    const char* advice() const;

    const scene::Scene& scene_;
    NodalState start_;
    std::vector<double> whole_kg_, inside_kg_;  // of each node; inside: of the fluid
    Vec3 gravity_m_s2_{};
    bool driven_ = false;  // the fluid gets energy through sides or forces of its own
    bool lags_ = false;    // the enclosed fluid is a force (light bodies)
    double min_j_ = 0;     // gains below it are not judged

    struct Record {
        double rows = 0;
        double stored_at_start = 0, moved_at_start = 0, nodes_at_start = 0;
        double dipoles_at_start = 0;
        double fluid_at_start = 0;
        double work = 0, residual = 0, lowest = 0, gained = 0;
        double unpaid_at_start = 0, unpaid = 0, for_nothing = 0, most_for_nothing = 0;
    } record_;
};

}  // namespace magfsi::lammps
