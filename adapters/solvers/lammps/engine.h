// SPDX-License-Identifier: GPL-2.0-or-later
// The LAMMPS library as the structure solver: takes script commands, makes steps, returns
// nodal arrays. Node n of the scene's bodies, counted from 0 over all of them, is the
// atom with ID n + 1. Users of this header do not see LAMMPS's own headers.
//   engine.cpp        commands, steps, nodes
//   engine_state.cpp  state for checkpoints and repeated steps
//   engine_fixes.cpp  our fixes in LAMMPS's step: the fluid's force, the energy audit
#pragma once

#include <mpi.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "adapters/solvers/bodies/nodal_state.h"
#include "coupler/scheme/structure_solver.h"
#include "structure/lammps/rigid_states.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace magfsi::structure {
class KeepsPairs;
}

namespace magfsi::lammps {

using bodies::NodalState;

// NaN check: true if all values are finite. NaN and infinity have all exponent bits set,
// and only for them does adding one to the exponent carry into the (masked) sign bit.
// Unlike sums, a bitwise or may be evaluated in any order, so that the compiler can
// vectorise the loop: the check costs no more than reading the values.
inline bool all_finite(std::span<const double> values) {
    constexpr std::uint64_t exponent = 0x7ff0000000000000, one = 0x0010000000000000;
    std::uint64_t carried = 0;
    for (const double value : values)
        carried |= (std::bit_cast<std::uint64_t>(value) & exponent) + one;
    return (carried >> 63) == 0;
}

// Local arrays have three values per atom, first those of this rank's own atoms, then
// those of its ghost atoms. An error inside LAMMPS ends the whole job (lammps_exit.h).
class Engine final : public coupler::StructureSolver {
  public:
    // Creates LAMMPS on these ranks, with its log in the given file. Collective.
    Engine(MPI_Comm comm, const std::filesystem::path& log);
    ~Engine() override;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    void command(const std::string& line);  // one line of a script; collective
    std::string version() const;            // version of LAMMPS

    // Computes the first forces and distributes the atoms among the ranks; from here on
    // their local indices do not change. Collective.
    void set_up();
    // Sets the number of LAMMPS steps in a coupled step.
    void set_substeps(int substeps) { substeps_ = substeps; }
    // Makes one coupled step; collective, as is take_steps.
    void advance() override { take_steps(substeps_); }
    void take_steps(int steps);
    // Divides the time step by the factor and multiplies the number of steps done by it,
    // so that the present time, their product, stays the same.
    void divide_step(int factor);

    // Local index of an atom on this rank, owned or ghost; -1 if it is neither.
    int local_index(int atom_id) const;
    bool owns(int atom_id) const;
    // Positions [m] and velocities [m/s] of local and ghost atoms.
    const double* positions() const override;
    const double* velocities() const override;
    void renew_ghost_velocities() override;  // collective
    // Lets LAMMPS call this function in each of its steps to add the fluid's force.
    void attach_fluid_force(NodalForce force) override;
    // Throws coupler::Diverged, which names a node of this rank whose position is NaN or
    // infinite. One check in a coupled step suffices: a NaN reaches only the neighbours
    // of its node in each substep.
    void check_finite(std::int64_t step) const override;

    // Positions, velocities and masses of all atoms in the order of their IDs, on the
    // root; empty on other ranks. Masses are those that LAMMPS integrates. atoms: number
    // of all atoms. Collective.
    NodalState gather(int atoms) const;

    // Sum of all forces on each node [N], likewise; with LammpsInput::reactions it
    // includes forces that rollers take up. Collective.
    std::vector<Vec3> gather_forces(int atoms) const;

    // The share of contact, platform and walls in these forces, likewise; for
    // LammpsInput::contact_load.
    std::vector<Vec3> gather_contact_forces(int atoms) const;

    // Entry n (from 1) of a fix's global vector. Collective. Throws std::logic_error if
    // there is no such fix.
    double fix_vector(const std::string& fix_id, int n) const;
    // A fix's global scalar, with the same conditions.
    double fix_scalar(const std::string& fix_id) const;

    // Adds the fix of the energy audit. drag_rate_1_s: rate of fix magttice/drag, or 0;
    // moved: the groups in prescribed motion. Collective.
    void attach_audit(double drag_rate_1_s, const std::vector<std::string>& moved);
    // Scalar of a compute, and entry n (from 1) of its vector. Collective.
    double compute_scalar(const std::string& compute_id) const;
    double compute_vector(const std::string& compute_id, int n) const;

    // State of the atoms for checkpoints: position, velocity, force and the values that
    // fixes keep with an atom. gather_nodes returns rows of node_values() numbers in the
    // order of the atoms' IDs, on the root only. Collective.
    std::size_t node_values() const;
    std::vector<double> gather_nodes(int atoms) const;
    // Restores such rows, which every rank must have completely. Collective.
    void put_nodes(std::span<const double> rows);
    // This rank's shares of the sums over time that fixes and the pair style keep (works
    // and losses), and back.
    std::vector<double> fix_sums() const;
    void put_fix_sums(std::span<const double> sums);
    // Values that the pair style keeps with pairs of nodes, the same on all ranks, and
    // back (structure/lammps/kept_pairs.h).
    std::vector<double> pairs() const;
    void put_pairs(std::span<const double> rows);
    // Motion of the rigid parts, and the numbers that continue it; the same on all ranks,
    // empty without rigid parts.
    std::vector<structure::RigidPartMotion> rigid_motions() const;
    std::vector<double> rigid_states() const;
    void put_rigid_states(std::span<const double> states);
    // The same state in memory, by local index, for a coupled step that is repeated.
    // Between the two calls atoms keep their ranks and indices. go_back is collective.
    void keep() override;
    void go_back() override;

    // Sets the number of the present LAMMPS step; to be called before set_up. Collective.
    void start_at(std::int64_t lammps_step);

  private:
    void evaluate_again();
    std::vector<double*> sums_in_fixes() const;
    structure::KeepsPairs* keeper() const;
    structure::MovesRigidParts* rigid_parts() const;
    int fix_number(const std::string& fix_id) const;
    std::vector<Vec3> gather_vectors(int atoms, const std::vector<double>& mine) const;

    MPI_Comm comm_;
    std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
    int substeps_ = 1;
    struct Kept {
        std::int64_t step = 0;
        std::vector<double> position, velocity;  // local and ghost atoms
        std::vector<double> force, of_fixes;     // local atoms
        std::vector<double> sums, pairs, rigid;
    } kept_;
};

}  // namespace magfsi::lammps
