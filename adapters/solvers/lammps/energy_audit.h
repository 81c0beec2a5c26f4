// SPDX-License-Identifier: GPL-2.0-or-later
// The energy balance of all bodies since the start (docs/energy_audit.md has its terms
// and equations). Exists only with probes.energy_audit.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/nodal_state.h"
#include "adapters/solvers/bodies/rigid_parts.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "coupler/output/summary.h"

namespace magfsi::lammps {

using bodies::NodalState;

// Energy of the fluid in the whole box [J]: the last two of the fluid's columns.
struct FluidEnergy {
    double sound = 0, kinetic = 0;
    double sum() const { return sound + kinetic; }
};

// Energies and works that the solvers report at one time, summed over all bodies [J].
// Works and losses are sums since the start.
struct EnergyTerms {
    // Stored energies.
    double elastic = 0, platform = 0, contact = 0, dipoles = 0;
    double work_field = 0;
    // Kinetic energy of the nodes in prescribed motion, less the work on them of all
    // forces except their drive. Its change is the work of the drive.
    double of_moved = 0;
    double lost_viscosity = 0, lost_drag = 0, lost_friction = 0;
    // Work on the body at the markers: by the coupling force, and by that of the enclosed
    // fluid.
    double by_fluid = 0, by_enclosed = 0;
    FluidEnergy fluid;
    // Work on the fluid at the markers by forces whose reaction no body feels
    // (coupler/immersed_boundary/layer_inertia.h).
    double for_nothing = 0;
};

struct StructureRun;
// Adds the fix to LAMMPS that sums the audit's terms in every step. Must come after all
// commands of the script, since its forces are those of the fixes before it. Collective.
void attach_audit(const StructureRun& run);
// All terms except the fluid's energy. Collective.
EnergyTerms collect_terms(const StructureRun& run);

class EnergyAudit {
  public:
    // start: the nodes at step 0, with the masses that LAMMPS integrates, which lack
    // those of the enclosed fluid. Needed on the root only, as are the states of the
    // rows. Keeps a reference to the scene.
    EnergyAudit(const scene::Scene& scene, const bodies::Solids& solids,
                NodalState start);

    // Names of the columns. Effects that the scene does not have get none.
    std::vector<std::string> columns() const;

    // One value for each column [J]. state: with masses as in the constructor. The first
    // call must be for step 0: its energies are those of the start.
    std::vector<double> row(const NodalState& state, const EnergyTerms& terms);

    output::EnergySummary summary() const;

    // Fault at the last row, as a sentence for the user; empty without one. It is a fault
    // if bodies and fluid have gained energy that no work accounts for, far more than
    // errors of the time integration and sound explain.
    std::string fault() const;

    // State of the audit for checkpoints, and back.
    std::vector<double> carried() const;
    void set(std::span<const double> carried);

  private:
    // Kinetic energies and works of the weight [J], with three masses of each node: whole
    // (kinetic_whole), less the fluid in its place (kinetic, work_weight), and as
    // integrated by LAMMPS (kinetic_nodes, work_weight_nodes).
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
    std::string advice() const;

    const scene::Scene& scene_;
    NodalState start_;
    // Mass of each node of the bodies themselves, and of the fluid in its place.
    std::vector<double> whole_kg_, inside_kg_;
    // Of rigid parts, with the same masses, and those that LAMMPS integrates.
    bodies::RigidKinetics whole_, inside_, nodes_;
    Vec3 gravity_m_s2_{};
    bool driven_ = false;  // true if sides of the box or a body force drive the fluid
    bool lags_ = false;    // true if the enclosed fluid is a force (light bodies)
    double min_j_ = 0;     // smaller gains are not judged

    // The state over the rows so far [J]. Checkpoints keep it as an array of doubles
    // (bit_cast): members of other types do not work here.
    struct Record {
        double rows = 0;  // number of rows
        double stored_at_start = 0, moved_at_start = 0, nodes_at_start = 0;
        double dipoles_at_start = 0;
        double fluid_at_start = 0;
        // Largest work and largest residual; lowest energy that no work accounts for, and
        // the largest rise above it.
        double work = 0, residual = 0, lowest = 0, gained = 0;
        // Energy less all works (`unpaid`) at the start and at the last row; EnergyTerms
        // for_nothing at the last row and its largest magnitude.
        double unpaid_at_start = 0, unpaid = 0, for_nothing = 0, most_for_nothing = 0;
    } record_;
};

}  // namespace magfsi::lammps
