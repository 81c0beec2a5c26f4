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
#include "adapters/solvers/openfoam/obstacles.h"

namespace magfsi::openfoam {

// Time step and number of steps for controlDict.
struct CaseTimes {
    double step_s = 0;
    std::int64_t steps = 1;
    // Steps between time folders: of a stock run, and with fluid.openfoam.write of the
    // run itself.
    std::int64_t steps_between_files = 1;
    // The run continues another in the same folder, whose time folders stay.
    bool goes_on = false;
    // snappyHexMesh moves points of the mesh.
    bool snapped = false;
};

// True if the scene asks for files of OpenFOAM's own: time folders or function objects.
bool has_own_files(const scene::Fluid& fluid);

// Deletes and writes system/, constant/ and 0/ in `folder`, the user's dictionaries among
// them. With files of OpenFOAM's own each of several ranks has its folder processorN/ as
// in any parallel case. Called by rank 0 only. Throws output::FileError.
void write_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                const CaseTimes& times, int ranks);

// Makes the mesh of a scene with obstacles in the case, by OpenFOAM's programs. Called by
// rank 0 only, after write_case.
void make_obstacle_mesh(const std::filesystem::path& folder, const scene::Fluid& fluid,
                        const BoxMesh& mesh, const ObstaclePlan& plan);

// Adds blockMeshDict, the body force, the inlets' conditions and the last time's folder
// for stock programs. Must be called after the engine has read the case: within the
// engine these parts come from FoamFluid and would act twice.
void complete_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                   const CaseTimes& times, const BoxMesh& mesh);

}  // namespace magfsi::openfoam
