// SPDX-License-Identifier: GPL-2.0-or-later
// The rigid parts of a scene's bodies: their names, and the kinetic energy that the
// motion of their nodes does not tell.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "adapters/solvers/bodies/scene_to_body.h"
#include "structure/lammps/rigid_states.h"

namespace magfsi::bodies {

// A rigid part in the list of all: that of NodalState::rigid.
struct RigidPartOfScene {
    std::size_t body = 0;
    int part = 0;        // number in the body
    std::string column;  // what its columns begin with: "BODY" or "BODY.REGION"
};
std::vector<RigidPartOfScene> rigid_parts_of(const Solids& solids);

// The turn from a body's own frame to the place where it starts.
Eigen::Quaterniond turn_at_start(const scene::Placement& initial);
// Angles of turns about the axes x, y and z of space, made in this order.
structure::Vec3 angles_rad(const Eigen::Quaterniond& turn);

// Kinetic energies beyond those of the masses at the nodes. The latter are lumped, with
// inertias that are too large (structure/lattice/rigid_mass.h), so that these are
// negative.
class RigidKinetics {
  public:
    RigidKinetics() = default;
    // start_m: positions of the nodes of all bodies at step 0, body after body.
    RigidKinetics(const Solids& solids, std::span<const structure::Vec3> start_m);

    // Of all parts of one body, or of all bodies [J].
    double beyond_nodes_j(std::span<const structure::RigidPartMotion> motions,
                          std::size_t body) const;
    double beyond_nodes_j(std::span<const structure::RigidPartMotion> motions) const;

  private:
    std::vector<RigidPartOfScene> parts_;
    std::vector<Eigen::Matrix3d> inertia_kg_m2_;  // at step 0
};

}  // namespace magfsi::bodies
