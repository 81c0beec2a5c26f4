// SPDX-License-Identifier: GPL-2.0-or-later
// Correction for the inertia of the fluid that one layer of markers carries along a thin
// sheet.
//
// In motion along its surface a layer of markers moves fluid as if it had a thickness of
// its own, 1.1 to 1.7 grid spacings (adapters/solvers/bodies/wall_of_planes.h). Where the
// sheet is thinner, the difference is fluid that moves with it and should not. Its
// inertia is taken away by giving the fluid the momentum that this fluid gains, without a
// reaction on the body,
//   J <- J + rho dV (W - W'),  W = (1 - n n) V,
// with n the normal, V the marker's mean velocity in the step, W' the W of the step
// before, and dV the volume outside the sheet's own, negative where the sheet is thicker
// than its layer.
// Motion across the surface needs no correction: there the depth of the rim is set so
// that the whole sheet moves the right amount of fluid.
//
// The momentum goes to the fluid and not to the body, because a force on the body would
// be explicit, come a step late and drive a light sheet. It is spread over some twenty
// steps, without lag in all: twice the running mean of the change less the mean of that
// mean. Given at once it makes sheets of half a spacing diverge.
//
// Each marker takes back what it gave: over a stroke, however the sheet turns, the sum of
// what is given is zero, which would not be so for (1 - n n)(V - V'). The energy audit
// includes the work of what is given. A couple on the sheet would make the energy exact,
// too, but needs the velocity of the fluid around it and is left out
// (docs/lab/coupling_measurements.md).
#pragma once

#include <span>
#include <vector>

#include "coupler/immersed_boundary/slip.h"

namespace magfsi::coupler {

// The impulses that the fluid gets from this rank's markers, with this correction.
class LayerInertia {
  public:
    // areas: pieces of surface of the markers whose beyond_m3 is not zero, for their
    // normals.
    LayerInertia(std::span<const Marker> markers, std::span<const MarkerArea> areas,
                 double fluid_density_kg_m3);

    // Sets W of the markers before the first step to that of the fluid [m/s], which is
    // carried along. position: nodal positions [m], three numbers per node.
    void start(std::span<const Vec3> fluid_velocity, const double* position);

    // Adds a coupled step after the structure has done it. impulse: what the markers gave
    // [N s]; mean_velocity: theirs in the step [m/s]; position: nodal positions [m].
    void add(std::span<const Vec3> impulse, std::span<const Vec3> mean_velocity,
             const double* position);

    // Impulses that the fluid is given in all, the markers' own and the correction [N s].
    std::span<const Vec3> given() const { return given_; }

    // State for checkpoints: W of the last step, the running mean of its change in a
    // step, and the mean of that mean [m/s].
    std::span<Vec3> last_along() { return last_along_; }
    std::span<Vec3> mean() { return mean_; }
    std::span<Vec3> mean_of_mean() { return mean_of_mean_; }

  private:
    // A marker whose layer is thicker or thinner than the sheet.
    struct Beyond {
        Marker marker;
        MarkerArea area;
        double mass_kg;  // rho dV, may be negative
    };
    std::vector<Beyond> layer_;
    std::vector<Vec3> last_along_;           // W of the last step [m/s]
    std::vector<Vec3> mean_, mean_of_mean_;  // change of W per step [m/s]
    std::vector<Vec3> given_;
};

}  // namespace magfsi::coupler
