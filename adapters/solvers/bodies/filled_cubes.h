// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of cubes that fill a closed surface. The surface cuts the cubes along it: each
// has mass, stiffness and magnetisation in proportion to the part of it that lies inside,
// and material that lies in omitted cubes counts for their neighbours. So mass and volume
// are those of the surface, and bending converges with the square of the cubes' edge
// (after the finite cell method of Parvizian, Duester and Rank, Comput. Mech. 41 (2007)
// 121, without its quadrature).
#pragma once

#include "structure/body.h"

namespace magfsi::bodies {

// Mesh of the cubes whose centres lie inside the surface of the STL file, in the frame of
// the file [m]. Its solid_share is the material that each cube stands for, in volumes of
// a whole cube. Throws std::invalid_argument if the file cannot be used (make_stl_solid)
// or takes more than two million cubes.
structure::Mesh filled_mesh(const structure::VoxelMesh& voxels);

// Scales density, moduli, viscosity and magnetisation of each element of a body with its
// solid share. Adds a material for each material and share other than 1. To be called
// once.
void weigh(structure::Body& body);

// Volume inside the surface of the file [m3], independent of its cubes.
double surface_volume_m3(const structure::VoxelMesh& voxels);

}  // namespace magfsi::bodies
