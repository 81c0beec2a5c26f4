// SPDX-License-Identifier: GPL-2.0-or-later
// The scene's box as OpenFOAM's mesh: planes between cells, uniform or growing away from
// a uniform part; and the uniform grid that the coupling works on.
#pragma once

#include <array>
#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/openfoam/engine/engine.h"
#include "coupler/immersed_boundary/grid.h"

namespace magfsi::openfoam {

// Uniform part of a graded axis [m].
struct UniformPart {
    double from_m = 0, to_m = 0;
    double growth = 1.1;  // largest ratio of neighbouring cells outside
};

// Planes between the cells along an axis [m], ascending, from 0 to length_m, which must
// be a whole number of spacings. The uniform part is widened to whole spacings. On each
// side of it cells grow by a constant ratio, as few as can fill the rest.
std::vector<double> axis_planes(double length_m, double spacing_m,
                                const UniformPart* uniform);

// For each cell of the uniform grid, the mesh cell that contains its centre.
std::vector<int> cell_of_uniform(const std::vector<double>& planes_m, double spacing_m);

// The mesh of the scene's box for a rank. It is cut along its longest axis, in cells.
// Throws std::invalid_argument for boundaries that OpenFOAM lacks and for more ranks than
// layers of cells.
BoxMesh to_mesh(const scene::Fluid& fluid, int rank, int ranks);

// Number of cells of the whole mesh along each axis.
std::array<int, 3> mesh_cells(const BoxMesh& mesh);

// The uniform grid of the coupling, with the part that each rank owns. A cell belongs to
// the rank whose mesh cell contains its centre.
coupler::Grid to_grid(const scene::Fluid& fluid, const BoxMesh& mesh);

}  // namespace magfsi::openfoam
