// SPDX-License-Identifier: GPL-2.0-or-later
// The part of `magfsi explain` about OpenFOAM as the fluid solver.
#pragma once

#include <string>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"

namespace magfsi::openfoam {

// Text with cells, time step, Courant number, grid Reynolds number, memory and warnings.
// `solids` and `ranks` are not used. Throws std::invalid_argument on what the solver
// refuses.
std::string explain(const scene::Scene& scene, const bodies::Solids& solids, int ranks);

// Largest number of ranks on which the scene's fluid runs.
int most_ranks(const scene::Scene& scene);

// Returns why this build cannot run OpenFOAM and what to do, or "". Only looks for files
// and loads nothing.
std::string missing();

}  // namespace magfsi::openfoam
