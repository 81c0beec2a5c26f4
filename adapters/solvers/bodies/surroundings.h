// SPDX-License-Identifier: GPL-2.0-or-later
// Loads and supports of the bodies on a path of equilibria that Newton's method finds.
#pragma once

#include <vector>

#include "adapters/scene/scene.h"
#include "structure/equilibrium/static_problem.h"

namespace magfsi::bodies {

// The surroundings of each body, in the order of the scene: field gradient, field
// sources, platform and groups of driven nodes. solids: the scene's bodies by to_body.
// Throws std::invalid_argument on faces in prescribed motion that touch held ones, and on
// bodies that have no equilibrium (structure::require_held).
std::vector<structure::Surroundings> to_surroundings(
    const scene::Scene& scene, const std::vector<structure::Body>& solids);

// The loads on a body at a time on the path: uniform field, gravity, shares of gradient
// and sources, displacements of the driven groups.
structure::StaticLoads loads_at(const scene::Scene& scene, const scene::Body& body,
                                double time_s);

// Positions of the nodes [m] of each body in equilibrium with the loads of time 0, for
// time.start: equilibrium. Instabilities are left: what is found is a state in which a
// real body would rest. Throws std::runtime_error if there is none.
std::vector<std::vector<structure::Vec3>> equilibria_at_start(
    const scene::Scene& scene, const std::vector<structure::Body>& solids);

}  // namespace magfsi::bodies
