// SPDX-License-Identifier: GPL-2.0-or-later
// The audits of the interface: momentum and power that the two sides find in a coupled
// step, and the work at the markers.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "coupler/immersed_boundary/direct_forcing.h"

namespace magfsi::coupler {

// What the body gave in a coupled step against what the fluid's cells received. Exists
// only when the scene asks for it (probes.interface_balance). One side's sums over one
// coupled step:
struct InterfaceBalance {
    Vec3 impulse_n_s{};
    double work_j = 0;             // impulse times sampled fluid velocity
    double impulse_scale_n_s = 0;  // sum of magnitudes: the scale of rounding
    double work_scale_j = 0;
};

// Adds a marker's share.
void add_marker(InterfaceBalance& sum, const Vec3& impulse, const Vec3& fluid_velocity);

// One side's balances of the steps since it was last asked.
class BalanceRecord {
  public:
    void add(const InterfaceBalance& step) { steps_.push_back(step); }

    // Sums over the ranks of comm (valid on its root), six numbers a step; starts anew.
    std::vector<double> collect(MPI_Comm comm);

    // This rank's sums of those steps, six numbers a step, for a checkpoint, and back.
    std::vector<double> values() const;
    void set(std::span<const double> values);

  private:
    std::vector<InterfaceBalance> steps_;
};

constexpr std::size_t balance_values = 6;

struct Mismatch {
    double momentum = 0;  // |given - received| / sum of |impulse|
    double power = 0;     // |given - received| / sum of |impulse . velocity|
};

// The worst step. given carries the scales. Infinite where something was received though
// nothing was given, and where a number is not finite.
Mismatch worst_mismatch(std::span<const double> given, std::span<const double> received);

// The impulse of all those steps [N s].
Vec3 impulse_of(std::span<const double> steps);

// Work that the immersed boundary does on the body, marker by marker. Exists only with
// probes.energy_audit.
class MarkerWork {
  public:
    explicit MarkerWork(std::size_t markers);

    // Before the first substep of a coupled step; then after each, with the velocity of
    // the half step, (x(n+1) - x(n)) / dt: the mean of the forces at both ends of the
    // substep times that is what the equation of motion takes up.
    void begin_step();
    void add_substep(const PenaltyForce& force, const double* nodal_velocity,
                     double duration_s);

    // After the coupled step: what the fluid was given at each marker [N s], of which the
    // markers gave `paid`, and their mean velocities in it.
    void add_given(std::span<const Vec3> given, std::span<const Vec3> paid,
                   std::span<const Vec3> mean_velocity);

    // Sums over this rank's markers since the start [J].
    double by_fluid_j() const { return sum(0); }     // by the coupling force
    double by_enclosed_j() const { return sum(1); }  // by the enclosed fluid's
    double for_nothing_j() const { return sum(2); }  // on the fluid, by what nobody paid

    // Kept in checkpoints, three numbers a marker: the works, and the last forces.
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
