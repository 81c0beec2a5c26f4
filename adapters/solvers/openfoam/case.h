// SPDX-License-Identifier: GPL-2.0-or-later
// The OpenFOAM case of a scene's fluid. The engine reads it but makes its mesh in memory.
// After the engine has read it, the case is completed for the stock programs: `blockMesh
// -case FOLDER` and `pimpleFoam -case FOLDER` then run the same flow by themselves,
// without bodies.
#pragma once

#include <cstdint>
#include <filesystem>

#include "adapters/scene/scene.h"
#include "adapters/solvers/openfoam/engine/engine.h"

namespace magfsi::openfoam {

// Time step and number of steps for controlDict.
struct CaseTimes {
    double step_s = 0;
    std::int64_t steps = 1;
    // Steps between field files of a stock run; the engine writes none.
    std::int64_t steps_between_files = 1;
};

// Deletes and writes system/, constant/ and 0/ in `folder`. Called by rank 0 only. Throws
// output::FileError.
void write_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                const CaseTimes& times);

// Adds blockMeshDict, the body force and the inlets' conditions for stock programs. Must
// be called after the engine has read the case: within the engine these parts come from
// FoamFluid and would act twice.
void complete_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                   const BoxMesh& mesh);

}  // namespace magfsi::openfoam
