// Work that the immersed boundary does on the body, marker by marker. Exists only with
// probes.energy_audit.
#pragma once

#include <span>
#include <vector>

#include "coupler/immersed_boundary/penalty_force.h"

namespace magfsi::lammps {

using coupler::Vec3;

class MarkerWork {
  public:
    explicit MarkerWork(std::size_t markers);

    // Before the first substep of a coupled step; then after each, with the velocity of
    // the half step, (x(n+1) - x(n)) / dt: the mean of the forces at both ends of the
    // substep times that is what the equation of motion takes up.
    void begin_step();
    void add_substep(const coupler::PenaltyForce& force, const double* nodal_velocity,
                     double duration_s);

    // Sums over this rank's markers since the start [J].
    double by_fluid_j() const { return sum(0); }     // by the coupling force
    double by_enclosed_j() const { return sum(1); }  // by the enclosed fluid's

    // Kept in checkpoints, three numbers a marker: both works, and the last forces.
    std::span<Vec3> works() { return works_; }
    std::span<Vec3> last_fluid_force() { return last_fluid_force_; }
    std::span<Vec3> last_enclosed_force() { return last_enclosed_force_; }

  private:
    double sum(std::size_t which) const;

    std::vector<Vec3> works_;
    std::vector<Vec3> last_fluid_force_, last_enclosed_force_;
    std::vector<Vec3> impulse_before_;
};

}  // namespace magfsi::lammps
