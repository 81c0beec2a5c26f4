// SPDX-License-Identifier: GPL-2.0-or-later
// The scene's box as OpenFOAM's mesh: planes between cells, uniform or growing away from
// a part that is; and the uniform grid by which the coupling sees it.
#pragma once

#include <array>
#include <vector>

#include "adapters/openfoam/engine/engine.h"
#include "adapters/scene/scene.h"
#include "coupler/immersed_boundary/grid.h"

namespace magfsi::openfoam {

struct UniformPart {
    double from_m = 0, to_m = 0;
    double growth = 1.1;  // largest ratio of neighbouring cells outside
};

// length_m is a whole number of spacings. The part is widened to whole spacings; outside,
// cells grow by one ratio a side, as few as fill the rest. Ascending, from 0 to length_m.
std::vector<double> axis_planes(double length_m, double spacing_m,
                                const UniformPart* uniform);

// The cell between the planes that holds the centre of each cell of the uniform grid.
std::vector<int> cell_of_uniform(const std::vector<double>& planes_m, double spacing_m);

BoxMesh to_mesh(const scene::Fluid& fluid, int rank, int ranks);

std::array<int, 3> mesh_cells(const BoxMesh& mesh);

// Where the mesh is graded, a cell of it stands for all cells of the uniform grid with
// their centres inside.
coupler::Grid to_grid(const scene::Fluid& fluid, const BoxMesh& mesh);

}  // namespace magfsi::openfoam
