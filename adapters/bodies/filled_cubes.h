// SPDX-License-Identifier: GPL-2.0-or-later
// Cubes that fill a closed surface. The surface cuts those at its steps: each has mass,
// stiffness and magnetisation in proportion to what it holds, and what lies in cubes that
// are left out counts for their neighbours. So mass and volume are the surface's, and
// bending converges with the square of the cubes' edge (after the finite cell method of
// Parvizian, Duester and Rank, Comput. Mech. 41 (2007) 121, without its quadrature).
#pragma once

#include "structure/body.h"

namespace magfsi::bodies {

// Those whose middle lies inside, in the file's frame. Its regions are cubes of one
// weight; none where all are whole. Throws std::invalid_argument.
structure::Mesh filled_mesh(const structure::VoxelMesh& voxels);

// How much the cubes of a region hold, of a cube.
double weight_of_region(const structure::Mesh& mesh, int region);

// Gives the elements of such a mesh their part of material and magnetisation.
void weigh(structure::Body& body);

// Held by the surface of the file, without its cubes.
double surface_volume_m3(const structure::VoxelMesh& voxels);

}  // namespace magfsi::bodies
