// Eq. (13): the force between a marker and the fluid around it, F = -kappa (V - U), with
// V the marker's present velocity and U the fluid's velocity sampled at the start of the
// coupled step. kappa = strength * 2 rho dV / dt: at strength 1 the fluid, given 2 rho /
// dt of the slip through Guo's forcing, is brought to the marker's velocity in one step.
//
// The force is evaluated anew in every substep of the structure. Held over the substeps
// it would sample sheet modes above half the fluid's step rate aliased and pump them.
#pragma once

#include <span>
#include <vector>

#include "coupler/immersed_boundary/enclosed_fluid.h"
#include "coupler/immersed_boundary/markers.h"

namespace magfsi::coupler {

struct PenaltyScale {
    double strength = 1;
    double fluid_density_kg_m3 = 0;
    double coupled_step_s = 0;
    double enclosed_follow = EnclosedFluidScale{}.follow;

    // Drag coefficient [kg/s] of a marker.
    double coefficient(const Marker& marker) const {
        return strength * 2 * fluid_density_kg_m3 * marker.volume_m3 / coupled_step_s;
    }
};

class PenaltyForce {
  public:
    PenaltyForce(std::vector<Marker> markers, const PenaltyScale& scale,
                 const Vec3& gravity_m_s2);

    const std::vector<Marker>& markers() const { return markers_; }

    // The fluid's velocity at every marker for the coming coupled step [m/s]; clears the
    // impulses. owed: what the fluid was given besides, which the body pays by a constant
    // force over the step [N s]; empty: nothing.
    void begin_step(std::span<const Vec3> fluid_velocity,
                    std::span<const Vec3> owed = {});

    // After begin_step: U is not held over the coupled step but goes linearly from start
    // to end; each substep has that of its middle.
    void let_change(std::span<const Vec3> start, std::span<const Vec3> end);

    // After begin_step: U is held at another value, but for the enclosed fluid's sake.
    void hold(std::span<const Vec3> fluid_velocity);

    // One substep: adds the forces, with those of the enclosed fluid, to the nodes
    // (nodal_force[3 * node + d], [N]) and the impulse of duration_s to the markers'
    // sums.
    void apply(const double* nodal_velocity, double* nodal_force, double duration_s);

    std::span<const Vec3> fluid_velocity() const { return fluid_velocity_; }

    // What the markers gave to the fluid since begin_step [N s].
    std::span<const Vec3> impulse() const { return impulse_; }

    // On every marker over the coupled step [N]: of the enclosed fluid, less what is
    // paid.
    std::span<const Vec3> constant_force() const {
        return paying_.empty() ? enclosed_.force() : std::span<const Vec3>(paying_);
    }

    EnclosedFluid& enclosed() { return enclosed_; }
    const EnclosedFluid& enclosed() const { return enclosed_; }

  private:
    void follow(double duration_s);

    std::vector<Marker> markers_;
    std::vector<double> kappa_;
    EnclosedFluid enclosed_;
    double coupled_step_s_;
    double elapsed_s_ = 0;  // of the coupled step
    std::vector<Vec3> fluid_velocity_;
    std::vector<Vec3> start_, change_;  // of U over the step; empty where it is held
    std::vector<Vec3> impulse_;
    std::vector<Vec3> paying_;  // filled only where something is owed
};

}  // namespace magfsi::coupler
