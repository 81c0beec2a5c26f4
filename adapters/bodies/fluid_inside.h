// SPDX-License-Identifier: GPL-2.0-or-later
// The grid has fluid inside a body, too, which moves with it. Its inertia must be taken
// away again, and its weight is the buoyancy: as much as the body's own mass bears comes
// off the mass of its nodes, which is exact at any frequency; the rest is a force on the
// markers that follows the fluid (coupler/immersed_boundary/direct_forcing.h).
#pragma once

#include <vector>

#include "adapters/scene/scene.h"
#include "structure/body.h"

namespace magfsi::bodies {

// Of a node's mass, what may come off it for the fluid inside. The nodes keep a third:
// their stable step is that of a body of a third of the density, at least 0.58 of their
// own.
constexpr double largest_part_off_nodes = 2.0 / 3;

// True if damping slows down the nodes; a rate of 0 is no damping.
inline bool has_drag(const scene::Scene& scene) {
    return scene.damping && scene.damping->rate_1_s > 0;
}

// Of a body as bodies::to_body gives it, the density that comes off its nodes [kg/m3]:
// the fluid's, or less for light bodies; 0 without a fluid, and where `damping` slows
// down the nodes by their mass.
double off_nodes_kg_m3(const scene::Scene& scene, const structure::Body& body);

// The scene's bodies with the inertia and the weight that their nodes have.
std::vector<structure::Body> bodies_in_fluid(const scene::Scene& scene);

// The whole mass of each node [kg], body after body.
std::vector<double> whole_masses_kg(const scene::Scene& scene);

// The mass of the fluid in its place [kg]; of a scene with a fluid.
std::vector<double> inside_masses_kg(const scene::Scene& scene);

}  // namespace magfsi::bodies
