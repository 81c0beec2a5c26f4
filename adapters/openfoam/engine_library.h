// Finds and loads the library with OpenFOAM's solver.
#pragma once

#include <filesystem>
#include <memory>

#include "adapters/openfoam/engine/engine.h"

namespace magfsi::openfoam {

// Why this build cannot run OpenFOAM, and what to do; empty when it can. Loads nothing.
std::string missing();

// Throws std::runtime_error when a library is missing or OpenFOAM refuses the case.
// Collective.
std::unique_ptr<Engine> load_engine(const EngineSetup& setup);

}  // namespace magfsi::openfoam
