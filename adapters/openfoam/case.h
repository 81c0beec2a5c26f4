// SPDX-License-Identifier: GPL-2.0-or-later
// The case that OpenFOAM reads: what is to be solved and how. The engine makes its mesh
// in memory. After a run the case is completed for the stock programs: `blockMesh -case
// FOLDER` and `pimpleFoam -case FOLDER` then run the same flow by themselves, without
// bodies.
#pragma once

#include <cstdint>
#include <filesystem>

#include "adapters/openfoam/engine/engine.h"
#include "adapters/scene/scene.h"

namespace magfsi::openfoam {

struct CaseTimes {
    double step_s = 0;
    std::int64_t steps = 1;
    std::int64_t steps_between_files = 1;  // of a stock run; the engine writes none
};

// Writes system/, constant/ and 0/ into folder. Throws output::FileError.
void write_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                const CaseTimes& times);

// Once the engine has read the case, which must not take these for its own: inlets and
// the body force are the adapter's there.
void complete_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                   const BoxMesh& mesh);

}  // namespace magfsi::openfoam
