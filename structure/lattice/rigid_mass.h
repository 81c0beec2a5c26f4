// SPDX-License-Identifier: GPL-2.0-or-later
// Mass, centre and inertia of rigid parts, those of the meshed solid.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

struct RigidMass {
    double mass_kg = 0;
    Vec3 centre_m{};
    Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  // about the centre of mass
};

// What a rigid part moves with it: its own solid, plus the masses that the soft elements
// around it have at the nodes that they share with it. Such a node follows the rigid
// part, so that the kinetic energy of its soft share is that of a point fixed to the
// part. The solid's own integrals are exact for its mesh (3 x 3 x 3 Gauss points, as the
// integrand x_i x_j |J| of a trilinear element has the degree 4 along each of its axes);
// masses lumped at its nodes would have the same sum and centre, but an inertia that is
// too large by 2 / n^2 along an axis of n elements. nodes_m: positions of all nodes of
// the body, which may be turned and moved but not deformed.
RigidMass rigid_mass(const Body& body, int part, std::span<const Vec3> nodes_m);

// The inertia of the part's solid less that of its masses lumped at the nodes [kg m2],
// about the centre of mass: what the motion of the nodes alone does not tell of its
// kinetic energy, 1/2 w.(this)w.
Eigen::Matrix3d inertia_beyond_nodes_kg_m2(const Body& body, int part,
                                           std::span<const Vec3> nodes_m);

// Largest eigenvalue of springs or dampers on the nodes of a rigid part, each the same
// along every axis, over the part's mass and inertia: [1/s2] of stiffnesses [N/m], [1/s]
// of drags [kg/s]. of_node: one a node of the body.
double rate_on_part(const Body& body, int part, const std::vector<double>& of_node);

// Magnetic moment of the part's elements [A m2], undeformed; 0 without magnetisation.
Vec3 moment_of_part_a_m2(const Body& body, int part);

}  // namespace magfsi::structure
