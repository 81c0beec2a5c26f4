// SPDX-License-Identifier: GPL-2.0-or-later
// What acts on the bodies of a path of equilibria by Newton's method.
#pragma once

#include <vector>

#include "adapters/scene/scene.h"
#include "structure/equilibrium/static_problem.h"

namespace magfsi::bodies {

// Of each body. solids: to_body of each. Throws std::invalid_argument on faces that are
// moved and touch ones that are held, and on what has no equilibrium.
std::vector<structure::Surroundings> to_surroundings(
    const scene::Scene& scene, const std::vector<structure::Body>& solids);

// At this time on the path.
structure::StaticLoads loads_at(const scene::Scene& scene, const scene::Body& body,
                                double time_s);

}  // namespace magfsi::bodies
