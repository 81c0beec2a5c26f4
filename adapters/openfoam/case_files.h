// The case that OpenFOAM reads: what is to be solved and how. The mesh is made in memory.
#pragma once

#include <filesystem>

#include "coupler/scene/scene.h"

namespace magfsi::openfoam {

// Writes system/, constant/ and 0/ into folder. Throws output::FileError.
void write_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                double step_s);

}  // namespace magfsi::openfoam
