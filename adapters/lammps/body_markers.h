// SPDX-License-Identifier: GPL-2.0-or-later
// The markers of a scene's bodies as a rank of LAMMPS sees them.
#pragma once

#include <vector>

#include "adapters/lammps/engine.h"
#include "adapters/scene/scene.h"
#include "coupler/scheme/structure_coupling.h"

namespace magfsi::lammps {

// After engine.set_up(), with the bodies where they start, also before a restart: a rank
// takes the markers of the elements whose first node it owns. Markers that lie in an
// obstacle take no part. first_node: atom id of each body's node 0.
coupler::BodyMarkers own_markers(const scene::Scene& scene, const Engine& engine,
                                 const std::vector<int>& first_node,
                                 const coupler::Grid& grid, const coupler::Clock& clock);

}  // namespace magfsi::lammps
