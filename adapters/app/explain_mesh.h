// SPDX-License-Identifier: GPL-2.0-or-later
// Lines of `explain` on the mesh of a body: its regions, and the errors that it makes.
// Those beyond a threshold come with a warning and advice.
#pragma once

#include <string>

#include "adapters/scene/scene.h"
#include "structure/body.h"

namespace magfsi::launch {

// Estimated error of the displacements by discretisation: the linear response of this
// mesh is compared with that of a reference (bodies::estimate_mesh_error).
std::string explain_error(const scene::Scene& scene, const scene::Body& body,
                          const structure::Body& solid);

// Advice on the shape of a block's bricks. The thickness is the body's shortest side.
std::string explain_bricks(const structure::Body& solid, const structure::Box& box);

// Error of the moments of inertia about the axes through the centre of mass, made by
// masses that sit in the nodes. It matters only for bodies that can turn freely.
std::string explain_moments(const scene::Scene& scene, const structure::Body& solid);

// Mass and principal moments of inertia of each rigid part.
std::string explain_rigid_parts(const structure::Body& solid);

// Each region with its number of elements.
std::string explain_regions(const structure::Mesh& mesh);

// Error of the volume of a body of cubes, whose surface has steps, against the closed
// surface of the STL file; also with cubes weighed by their share of the inside.
std::string explain_voxels(const structure::Body& solid,
                           const structure::VoxelMesh& voxels);

}  // namespace magfsi::launch
