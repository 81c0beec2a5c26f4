// SPDX-License-Identifier: GPL-2.0-or-later
// Estimate of a mesh's error in the displacements of a body, from a linear solve on the
// mesh and one on the mesh refined once.
#pragma once

#include "structure/equilibrium/static_problem.h"

namespace magfsi::structure {

// The mesh with every hexahedron cut in eight at the middles of its edges, quads and
// volume. The nodes of the mesh come first; element e becomes elements 8 e to 8 e + 7.
// Faces, points and regions follow those that they are cut from.
Mesh refined(const Mesh& mesh);

// Displacements [m] of the nodes by the loads, linearised about the undeformed body,
// without rigid motions. Weight along an axis on which nothing holds the body is left
// out. Throws std::runtime_error if the body is unstable without loads, and as
// StaticProblem does.
std::vector<Vec3> linear_response(const Body& body, const StaticLoads& loads);

// Relative error of a displacement against the one on a refined mesh of assumed_strain
// elements, which is taken as exact: projection on that one, over its length, less 1. It
// is at least -1 (no displacement) and 0 if the refined one is zero. Validated for beams
// and distorted meshes (tests/unit/structure/mesh_error.cpp).
double displacement_error(const Vec3& here_m, const Vec3& on_refined_m);

}  // namespace magfsi::structure
