// SPDX-License-Identifier: GPL-2.0-or-later
// Audits of the interface: the momentum and power that the two sides find in a coupled
// step, and the work done at the markers.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "coupler/immersed_boundary/direct_forcing.h"

namespace magfsi::coupler {

// Sums of one side over one coupled step: over its markers on the structure, over its
// cells in the fluid. The two sides' sums are compared. Filled only if the scene asks for
// it (probes.interface_balance).
struct InterfaceBalance {
    // Impulse given to the fluid [N s].
    Vec3 impulse_n_s{};
    // Impulse times the fluid velocity sampled at the start of the step [J].
    double work_j = 0;
    // The same sums with the magnitude of each term: the scale of rounding errors. On the
    // structure only.
    double impulse_scale_n_s = 0;
    double work_scale_j = 0;
};

// Adds a marker's impulse [N s] and its work, given the fluid's velocity there [m/s].
void add_marker(InterfaceBalance& sum, const Vec3& impulse, const Vec3& fluid_velocity);

// The sums of one side for the steps since they were last collected.
class BalanceRecord {
  public:
    void add(const InterfaceBalance& step) { steps_.push_back(step); }

    // Sums over the ranks of comm, six numbers per step in the order of InterfaceBalance,
    // valid on its root. Forgets the steps. Collective.
    std::vector<double> collect(MPI_Comm comm);

    // This rank's sums of the recorded steps, six numbers per step, as a checkpoint
    // stores them; set() puts them back.
    std::vector<double> values() const;
    void set(std::span<const double> values);

  private:
    std::vector<InterfaceBalance> steps_;
};

// Numbers of an InterfaceBalance as it is stored and sent.
constexpr std::size_t balance_values = 6;

// Relative difference of momentum and of power between the two sides.
struct Mismatch {
    double momentum = 0;  // |given - received| / sum of |impulse|
    double power = 0;     // |given - received| / sum of |impulse . velocity|
};

// The largest mismatch over the steps; both arguments as collect() returns them, the
// scales from `given`. Infinite if something was received though nothing was given, or if
// a number is not finite.
Mismatch worst_mismatch(std::span<const double> given, std::span<const double> received);

// Sum of the steps' impulses [N s].
Vec3 impulse_of(std::span<const double> steps);

// Work at each marker, between the body and the immersed boundary. Made only for
// probes.energy_audit.
class MarkerWork {
  public:
    // markers: number of this rank's markers.
    explicit MarkerWork(std::size_t markers);

    // begin_step() comes before the first substep of a coupled step, add_substep() after
    // each substep. nodal_velocity: three numbers per node [m/s], that of the half step,
    // (x(n+1) - x(n)) / dt. Velocity Verlet takes up the mean of the forces at both ends
    // of the substep times this velocity; the work is summed accordingly.
    void begin_step();
    void add_substep(const PenaltyForce& force, const double* nodal_velocity,
                     double duration_s);

    // Adds a coupled step after its end: the impulses that the fluid was given at each
    // marker [N s], the part of them that the body paid for, and the markers' mean
    // velocities in the step [m/s].
    void add_given(std::span<const Vec3> given, std::span<const Vec3> paid,
                   std::span<const Vec3> mean_velocity);

    // Sums over this rank's markers since the start of the run [J].
    // Work of the coupling force on the body.
    double by_fluid_j() const { return sum(0); }
    // Work of the enclosed fluid's force on it.
    double by_enclosed_j() const { return sum(1); }
    // Work on the fluid by impulses that no body paid for.
    double for_nothing_j() const { return sum(2); }

    // State for checkpoints, three numbers per marker: the three works [J], and the
    // forces [N] at the end of the last substep.
    std::span<Vec3> works() { return works_; }
    std::span<Vec3> last_fluid_force() { return last_fluid_force_; }
    std::span<Vec3> last_enclosed_force() { return last_enclosed_force_; }

  private:
    double sum(std::size_t which) const;

    std::vector<Vec3> works_;
    std::vector<Vec3> last_fluid_force_, last_enclosed_force_;
    std::vector<Vec3> impulse_before_;
};

}  // namespace magfsi::coupler
