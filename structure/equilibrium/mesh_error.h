// SPDX-License-Identifier: GPL-2.0-or-later
// What a mesh does to the displacements of a body, told beforehand by a linear solve on
// it and one on the mesh refined once.
#pragma once

#include "structure/equilibrium/static_problem.h"

namespace magfsi::structure {

// Every hexahedron cut in eight at the middles of its edges, quads and volume. The nodes
// of the mesh come first; faces, points, regions and elements (8 e to 8 e + 7) follow
// those that they are cut from; there is no centre line.
Mesh refined(const Mesh& mesh);

// Response of the undeformed body to the loads, linearised, rigid motions apart, one
// vector a node; weight along an axis on which nothing holds the body is left out.
std::vector<Vec3> linear_response(const Body& body, const StaticLoads& loads);

// Of a displacement, from the same on a refined mesh of elements assumed_strain, which
// counts as right: above -1, which is no displacement at all. Validated for beams and
// distorted meshes (tests/unit/structure/mesh_error.cpp).
double displacement_error(const Vec3& here_m, const Vec3& on_refined_m);

}  // namespace magfsi::structure
