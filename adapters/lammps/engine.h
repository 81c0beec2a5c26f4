// SPDX-License-Identifier: GPL-2.0-or-later
// The LAMMPS library as the structure solver: commands in, steps, nodal arrays out. Hides
// LAMMPS's headers.
//   engine.cpp        commands, steps, nodes
//   engine_state.cpp  what a checkpoint and a repeated step keep
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

#include "adapters/bodies/nodal_state.h"
#include "coupler/scheme/structure_solver.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace magfsi::structure {
class KeepsPairs;
}

namespace magfsi::lammps {

using bodies::NodalState;
using bodies::Vec3;

// Whether there is no NaN and no infinity, at the price of reading the values. Those have
// all bits of their exponent set: one more there carries into the sign, which is else
// clear once the number's own is masked. Bits can be put together in any order, unlike
// sums, so that the compiler takes many at once.
inline bool all_finite(std::span<const double> values) {
    constexpr std::uint64_t exponent = 0x7ff0000000000000, one = 0x0010000000000000;
    std::uint64_t carried = 0;
    for (const double value : values)
        carried |= (std::bit_cast<std::uint64_t>(value) & exponent) + one;
    return (carried >> 63) == 0;
}

class Engine final : public coupler::StructureSolver {
  public:
    Engine(MPI_Comm comm, const std::filesystem::path& log);
    ~Engine() override;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    void command(const std::string& line);
    std::string version() const;  // of LAMMPS

    // First forces and the parallel layout; nodes keep their local indices from here on.
    void set_up();
    // How many of its steps make a coupled one.
    void set_substeps(int substeps) { substeps_ = substeps; }
    void advance() override { take_steps(substeps_); }
    void take_steps(int steps);
    // Steps of a whole part of those so far; the time, their number times the step,
    // stays.
    void divide_step(int factor);

    // Local index of an atom on this rank, owned or ghost; -1 if it is neither.
    int local_index(int atom_id) const;
    bool owns(int atom_id) const;
    const double* positions() const override;
    const double* velocities() const override;
    void renew_ghost_velocities() override;
    void attach_fluid_force(NodalForce force) override;
    // A NaN in one node reaches its neighbours in the next substep: one check in a
    // coupled step is enough to name the place.
    void check_finite(std::int64_t step) const override;

    // In the order of the atoms' ids; empty but on the root. Collective.
    NodalState gather(int atoms) const;

    // Of all forces on each node, likewise; those that rollers take away included where
    // the script keeps them (LammpsInput::reactions). Collective.
    std::vector<Vec3> gather_forces(int atoms) const;

    // Entry n (from 1) of a fix's global vector. Collective.
    double fix_vector(const std::string& fix_id, int n) const;
    double fix_scalar(const std::string& fix_id) const;  // collective

    // Only for the energy audit. moved: groups in prescribed motion. The scalar of a
    // compute is collective.
    void attach_audit(double drag_rate_1_s, const std::vector<std::string>& moved);
    double compute_scalar(const std::string& compute_id) const;
    double compute_vector(const std::string& compute_id, int n) const;  // from 1

    // What a checkpoint keeps. Of each atom position, velocity, force
    // and what fixes keep with it: rows of node_values() numbers in the order of the
    // atoms' ids, on the root only. Collective.
    std::size_t node_values() const;
    std::vector<double> gather_nodes(int atoms) const;
    // Puts such rows back; all of them on every rank. Collective.
    void put_nodes(std::span<const double> rows);
    // This rank's shares of the sums over time that fixes keep, and back.
    std::vector<double> fix_sums() const;
    void put_fix_sums(std::span<const double> sums);
    // What the pair style remembers of pairs of nodes (structure/lammps/kept_pairs.h).
    std::vector<double> pairs() const;
    void put_pairs(std::span<const double> rows);
    // The same in memory and by local index, for a coupled step that is done again:
    // between the two, atoms keep their ranks and indices.
    void keep() override;
    void go_back() override;

    // The number of the step that comes first; before set_up.
    void start_at(std::int64_t lammps_step);

  private:
    void evaluate_again();
    std::vector<double*> sums_in_fixes() const;
    structure::KeepsPairs* keeper() const;
    int fix_number(const std::string& fix_id) const;

    MPI_Comm comm_;
    std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
    int substeps_ = 1;
    struct Kept {
        std::int64_t step = 0;
        std::vector<double> position, velocity;  // of local and ghost atoms
        std::vector<double> force, of_fixes;     // of local atoms
        std::vector<double> sums, pairs;
    } kept_;
};

}  // namespace magfsi::lammps
