// What the stock programs need beyond case_files.h: after `blockMesh -case FOLDER`,
// `pimpleFoam -case FOLDER` runs the same flow by itself, without bodies.
#pragma once

#include <filesystem>

#include "adapters/openfoam/engine/engine.h"
#include "adapters/scene/scene.h"

namespace magfsi::openfoam {

// Once the engine has read the case, which must not take these for its own: inlets and
// the body force are the adapter's there.
void complete_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                   const BoxMesh& mesh);

// Takes away what the engine would stumble over in a folder that was used before: the
// body force, and a mesh that blockMesh made.
void clear_stock_case(const std::filesystem::path& folder);

}  // namespace magfsi::openfoam
