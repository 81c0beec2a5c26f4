// SPDX-License-Identifier: GPL-2.0-or-later
// Interface to the rigid parts of a run: their motion for probes, their state for
// checkpoints and repeated steps.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "base/vector/vec3.h"

namespace magfsi::structure {

// Motion of a rigid part at one time.
struct RigidPartMotion {
    Vec3 centre_m{};                                // of mass
    Eigen::Quaterniond turn{1, 0, 0, 0};            // since the start
    Vec3 velocity_m_s{}, angular_velocity_rad_s{};  // of the centre of mass, in space
    double kinetic_j = 0;
};

// The fix that moves the rigid parts of all bodies, in the order of the bodies and of
// their parts. All values are the same on every rank.
class MovesRigidParts {
  public:
    virtual ~MovesRigidParts() = default;
    virtual std::vector<RigidPartMotion> motions() const = 0;
    // Numbers that continue the motion exactly: RigidMotion::state_values for each part.
    virtual std::vector<double> states() const = 0;
    virtual void put_states(std::span<const double> states) = 0;
    // Kinetic energy [J] that the parts in prescribed motion, or all others, have beyond
    // that of the masses at their nodes.
    virtual double kinetic_beyond_nodes_j(bool of_prescribed) const = 0;
};

}  // namespace magfsi::structure
