// SPDX-License-Identifier: GPL-2.0-or-later
// The mesh of a box with obstacles, made by OpenFOAM's own programs.
#pragma once

#include <filesystem>
#include <string>

#include "adapters/scene/scene.h"
#include "adapters/solvers/openfoam/obstacles.h"

namespace magfsi::openfoam {

// A vector in OpenFOAM's syntax, with all digits.
std::string vector_text(const scene::Vec3& v);

// Text of snappyHexMeshDict for the obstacles that the blocks do not cut out. Surfaces of
// STL files are written into the case.
std::string snappy_dict(const std::filesystem::path& folder, const scene::Fluid& fluid,
                        const ObstaclePlan& plan);

// Makes constant/polyMesh by blockMesh and, where the plan needs it, snappyHexMesh, whose
// dictionaries must be there. Their output goes to log.NAME in the case. Throws
// std::runtime_error with what a program said if it fails. Called by rank 0 only.
void make_mesh_files(const std::filesystem::path& folder, const ObstaclePlan& plan);

}  // namespace magfsi::openfoam
