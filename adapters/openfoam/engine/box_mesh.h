// OpenFOAM's mesh of a box, made in memory: no file to write, decompose and read.
#pragma once

#include "Time.H"
#include "adapters/openfoam/engine/engine.h"
#include "autoPtr.H"
#include "fvMesh.H"

namespace magfsi::openfoam {

// Names of the patches, by side.
extern const std::array<const char*, 6> side_names;

// Of the sides of this rank's slab in the mesh's list of faces.
std::vector<int> side_order(const BoxMesh& box);

// Cells are numbered with x fastest. Collective.
Foam::autoPtr<Foam::fvMesh> make_mesh(const Foam::Time& time, const BoxMesh& box);

}  // namespace magfsi::openfoam
