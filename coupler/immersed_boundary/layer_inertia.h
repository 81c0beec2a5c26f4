// SPDX-License-Identifier: GPL-2.0-or-later
// The inertia of the fluid that one layer of markers carries along a thin sheet.
//
// Along its surface a layer of markers moves fluid as if it had a thickness of its own,
// 1.1 to 1.7 grid spacings (adapters/bodies/wall_of_planes.h). What the sheet is thinner
// than that is fluid that moves with it and should not: its inertia is taken away by
// giving the fluid, for nothing, the momentum that it gains,
//   J <- J + rho dV (W - W'),  W = (1 - n n) V,
// n the normal, V the marker's mean velocity in the step, W' that of the step before, dV
// the volume beyond the sheet's own, negative where the sheet is thicker than its layer.
// Across the surface nothing is too much: there the depth of the rim is set by what the
// whole sheet moves.
//
// The fluid gets it, not the body: a force on the body is explicit, comes a step late and
// drives a light sheet. It is given spread over some twenty steps, without lag in all: of
// the running mean and of the mean of that, twice the first less the second. What is
// given at once instead makes sheets of half a spacing diverge.
//
// Each marker takes back what it gave: over a stroke, however the sheet turns, the sum of
// what is given is zero (that of (1 - n n)(V - V') is not). The work of what is given is
// in the energy audit. A couple on the sheet would make the energy exact, too; it needs
// the velocity of the fluid around and is left out (docs/coupling_measurements.md).
#pragma once

#include <span>
#include <vector>

#include "coupler/immersed_boundary/slip.h"

namespace magfsi::coupler {

class LayerInertia {
  public:
    // areas: of the markers whose beyond_m3 is not zero, for their normals.
    LayerInertia(std::span<const Marker> markers, std::span<const MarkerArea> areas,
                 double fluid_density_kg_m3);

    // The velocity before the first step [m/s]: the fluid's, which is carried along.
    void start(std::span<const Vec3> fluid_velocity, const double* position);

    // After the structure's step: what the markers gave [N s], their mean velocities in
    // it, the nodes' positions (three numbers a node).
    void add(std::span<const Vec3> impulse, std::span<const Vec3> mean_velocity,
             const double* position);

    // What the fluid is given in all [N s].
    std::span<const Vec3> given() const { return given_; }

    // What the next step needs of those before: for checkpoints.
    std::span<Vec3> last_along() { return last_along_; }
    std::span<Vec3> mean() { return mean_; }
    std::span<Vec3> mean_of_mean() { return mean_of_mean_; }

  private:
    struct Beyond {
        Marker marker;
        MarkerArea area;
        double mass_kg;
    };
    std::vector<Beyond> layer_;
    std::vector<Vec3> last_along_;           // W of the step before [m/s]
    std::vector<Vec3> mean_, mean_of_mean_;  // of the change of W in a step [m/s]
    std::vector<Vec3> given_;
};

}  // namespace magfsi::coupler
