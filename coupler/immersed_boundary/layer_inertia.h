// The inertia of the fluid that one layer of markers carries along a thin sheet.
//
// Along its surface a layer of markers moves fluid as if it had a thickness of its own,
// 1.1 to 1.7 grid spacings (adapters/bodies/wall_of_planes.h). What the sheet is thinner
// than that is fluid that moves with it and should not: its inertia is taken away by
// giving the fluid, for nothing, the momentum that it gains,
//   J <- J + rho dV (1 - n n) (V - V'),
// n the normal, V and V' the marker's mean velocities of this step and of the one before,
// dV the volume beyond the sheet's own, negative where the sheet is thicker than its
// layer. Across the surface nothing is too much: there the depth of the rim is set by
// what the whole sheet moves.
//
// The fluid gets it, not the body: a force on the body is explicit, comes a step late and
// drives a light sheet. Half of what is owed is given at once, then half of the rest:
// with all at once sheets of 0.9 spacings diverge at lattice speeds of 0.025.
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
    void start(std::span<const Vec3> fluid_velocity);

    // After the structure's step: what the markers gave [N s], their mean velocities in
    // it, the nodes' positions (three numbers a node).
    void add(std::span<const Vec3> impulse, std::span<const Vec3> mean_velocity,
             const double* position);

    // What the fluid is given in all [N s].
    std::span<const Vec3> given() const { return given_; }

    // What the next step needs of those before: for checkpoints.
    std::span<Vec3> last_velocity() { return last_velocity_; }
    std::span<Vec3> owed() { return owed_; }

  private:
    struct Beyond {
        Marker marker;
        MarkerArea area;
        double mass_kg;
    };
    std::vector<Beyond> layer_;
    std::vector<Vec3> last_velocity_;
    std::vector<Vec3> owed_;  // of each marker, the change of velocity [m/s]
    std::vector<Vec3> given_;
};

}  // namespace magfsi::coupler
