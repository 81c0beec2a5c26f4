// The scene's box as OpenFOAM's mesh, and the uniform grid by which the coupling sees it.
#pragma once

#include <vector>

#include "adapters/openfoam/engine/engine.h"
#include "coupler/immersed_boundary/grid.h"
#include "adapters/scene/scene.h"

namespace magfsi::openfoam {

BoxMesh to_mesh(const scene::Fluid& fluid, int rank, int ranks);

std::array<int, 3> mesh_cells(const BoxMesh& mesh);

// Where the mesh is graded, a cell of it stands for all cells of the uniform grid with
// their centres inside.
coupler::Grid to_grid(const scene::Fluid& fluid, const BoxMesh& mesh);

}  // namespace magfsi::openfoam
