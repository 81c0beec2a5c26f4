// The force of penalty_force.h on all markers in one substep. In a file of its own, it is
// compiled to the same instructions whatever the class around it has besides.
#pragma once

#include <span>

#include "coupler/immersed_boundary/markers.h"

namespace magfsi::coupler {

// Of each marker: drag coefficient [kg/s], the fluid's velocity [m/s], a force that is
// constant over the coupled step [N].
struct MarkerPull {
    std::span<const Marker> markers;
    std::span<const double> kappa;
    std::span<const Vec3> fluid_velocity;
    std::span<const Vec3> constant;
};

// Adds the markers' forces to their nodes and what they give in duration_s to impulse.
void pull_nodes(const MarkerPull& pull, const double* nodal_velocity, double duration_s,
                double* nodal_force, std::span<Vec3> impulse);

}  // namespace magfsi::coupler
