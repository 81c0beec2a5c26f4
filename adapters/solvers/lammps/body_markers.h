// SPDX-License-Identifier: GPL-2.0-or-later
// Distribution of the markers of a scene's bodies among the ranks of LAMMPS.
#pragma once

#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "adapters/solvers/lammps/engine.h"
#include "coupler/scheme/structure_coupling.h"

namespace magfsi::lammps {

// The markers of this rank and the settings of what is measured at them. A rank takes the
// markers of those elements whose first node it owns; the other nodes must be ghosts on
// it. Markers whose stencil lies almost wholly in an obstacle are left out. To be called
// on every rank after engine.set_up(), with the bodies in their initial positions, before
// a restart moves them. first_node: atom ID of node 0 of each body. Throws
// std::logic_error if a node of a marker is not on this rank.
coupler::BodyMarkers own_markers(const scene::Scene& scene, const bodies::Solids& solids,
                                 const Engine& engine, const std::vector<int>& first_node,
                                 const coupler::Grid& grid, const coupler::Clock& clock);

}  // namespace magfsi::lammps
