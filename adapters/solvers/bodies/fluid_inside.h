// SPDX-License-Identifier: GPL-2.0-or-later
// Masses of bodies in a fluid. The fluid's grid has fluid inside a body, too, which moves
// with it. The inertia of this enclosed fluid must be subtracted (Uhlmann 2005; Kempe and
// Froehlich 2012); its weight is the buoyancy. As much of it as the body's own mass
// allows is subtracted from the masses of the nodes, which is exact at any frequency; the
// rest is a force on the markers that follows the fluid
// (coupler/immersed_boundary/direct_forcing.h).
#pragma once

#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "structure/body.h"

namespace magfsi::bodies {

// Largest part of a node's mass that is subtracted for the enclosed fluid. The nodes keep
// at least a third of their mass: their stable step is then that of a body of a third of
// the density, at least 0.58 = sqrt(1/3) times their own.
constexpr double largest_part_off_nodes = 2.0 / 3;

// True if damping slows down the nodes; a rate of 0 is no damping.
inline bool has_drag(const scene::Scene& scene) {
    return scene.damping && scene.damping->rate_1_s > 0;
}

// Density of enclosed fluid that is subtracted from the nodes of a body [kg/m3]: that of
// the fluid, or largest_part_off_nodes of the body's lightest material if this is less. 0
// without a fluid, and with `damping`, whose force is proportional to the nodes' masses.
// body: as bodies::to_body returns it, of the scene.
double off_nodes_kg_m3(const scene::Scene& scene, const structure::Body& body);

// The scene's bodies by to_bodies with densities less off_nodes_kg_m3: inertia and
// weight of their nodes are those that the structure solver integrates.
Solids bodies_in_fluid(const scene::Scene& scene, Solids solids);

// Mass of each node of the bodies themselves [kg], nothing subtracted, body after body.
std::vector<double> whole_masses_kg(const Solids& solids);

// The bodies with the densities of the fluid in their place. The scene must have a fluid.
Solids bodies_of_fluid(const scene::Scene& scene, Solids solids);

// Mass of the fluid that fills the place of the bodies, shared among their nodes [kg],
// body after body. The scene must have a fluid.
std::vector<double> inside_masses_kg(const scene::Scene& scene, Solids solids);

}  // namespace magfsi::bodies
