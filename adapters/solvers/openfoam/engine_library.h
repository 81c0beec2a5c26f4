// SPDX-License-Identifier: GPL-2.0-or-later
// Finds and loads the shared library with OpenFOAM's solver.
#pragma once

#include <filesystem>
#include <memory>

#include "adapters/solvers/openfoam/engine/engine.h"

namespace magfsi::openfoam {

// Loads the library, which stays loaded, and makes an engine. Sets WM_PROJECT_DIR if
// unset. Throws std::runtime_error if a library is missing or OpenFOAM refuses the case.
// Collective.
std::unique_ptr<Engine> load_engine(const EngineSetup& setup);

}  // namespace magfsi::openfoam
