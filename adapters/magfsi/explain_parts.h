// The parts of `magfsi explain`, a solver each.
#pragma once

#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

// Elements, what they do to the stiffness, steps. Throws std::invalid_argument on what
// only the mesh can tell.
std::string explain_structure(const scene::Scene& scene);

// The scheme in words, what it costs, and which one is recommended for these densities.
std::string explain_coupling(const scene::Scene& scene);

// SI and lattice values side by side, the collision and why, warnings with the values to
// use instead, memory on so many ranks. Throws std::invalid_argument on what the solver
// refuses.
std::string explain_fluid(const scene::Scene& scene, int ranks);

// Cells, step, Courant number, memory. Throws std::invalid_argument likewise.
std::string explain_openfoam(const scene::Scene& scene);

}  // namespace magfsi::launch
