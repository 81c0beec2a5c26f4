// The LAMMPS library as the structure solver: commands in, steps, nodal arrays out. Hides
// LAMMPS's headers.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "adapters/bodies/nodal_state.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace magfsi::lammps {

using bodies::NodalState;
using bodies::Vec3;

class Engine {
  public:
    Engine(MPI_Comm comm, const std::filesystem::path& log);
    ~Engine();
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    void command(const std::string& line);

    // First forces and the parallel layout; nodes keep their local indices from here on.
    void set_up();
    void advance(int substeps);
    // Steps of a whole part of those so far; the time, their number times the step,
    // stays.
    void divide_step(int factor);

    // Local index of an atom on this rank, owned or ghost; -1 if it is neither.
    int local_index(int atom_id) const;
    bool owns(int atom_id) const;
    const double* positions() const;  // three values a local or ghost atom
    // An owned one with a position that is no finite number; 0: none.
    int atom_without_place() const;
    // Those of ghosts are of LAMMPS's last half step until they are renewed. Collective.
    const double* velocities() const;
    void renew_ghost_velocities();

    // Called in every substep with the velocities and the force array.
    using NodalForce =
        std::function<void(const double* velocity, double* force, double step_s)>;
    void attach_fluid_force(NodalForce force);

    // In the order of the atoms' ids; empty but on the root. Collective.
    NodalState gather(int atoms) const;

    // Entry n (from 1) of a fix's global vector. Collective.
    double fix_vector(const std::string& fix_id, int n) const;
    double fix_scalar(const std::string& fix_id) const;  // collective

    // Only for the energy audit (audit/engine_audit.cpp). moved: groups in prescribed
    // motion. The scalar of a compute is collective.
    void attach_audit(double drag_rate_1_s, const std::vector<std::string>& moved);
    double compute_scalar(const std::string& compute_id) const;

    // What a checkpoint keeps (engine_state.cpp). Of each atom position, velocity, force
    // and what fixes keep with it: rows of node_values() numbers in the order of the
    // atoms' ids, on the root only. Collective.
    std::size_t node_values() const;
    std::vector<double> gather_nodes(int atoms) const;
    // Puts such rows back; all of them on every rank. Collective.
    void put_nodes(std::span<const double> rows);
    // This rank's shares of the sums over time that fixes keep, and back.
    std::vector<double> fix_sums() const;
    void put_fix_sums(std::span<const double> sums);
    // The same in memory and by place, for a coupled step that is done again: between the
    // two, atoms keep their ranks and places there (no contact). Of the fixes' sums and
    // what they keep with atoms, too (engine_snapshot.cpp). go_back is collective.
    struct Snapshot {
        std::int64_t step = 0;
        std::vector<double> position, velocity;  // of local and ghost atoms
        std::vector<double> force, kept;         // of local atoms
        std::vector<double> sums;
    };
    void keep(Snapshot& snapshot) const;
    void go_back(const Snapshot& snapshot);

    // The number of the step that comes first; before set_up.
    void start_at(std::int64_t lammps_step);
    // Atoms to the ranks of their present places and new lists of neighbours; forces are
    // put back after it. For scenes where atoms migrate. Collective.
    void renew_neighbours();

  private:
    void look_again();
    std::vector<double*> sums_in_fixes() const;
    int fix_number(const std::string& fix_id) const;

    MPI_Comm comm_;
    std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
};

}  // namespace magfsi::lammps
