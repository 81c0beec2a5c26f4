// SPDX-License-Identifier: GPL-2.0-or-later
// The scene's bodies, their meshes and loads in the terms of structure/.
#pragma once

#include <optional>

#include "adapters/scene/scene.h"
#include "structure/body.h"

namespace magfsi::bodies {

// Throws std::invalid_argument on a mesh file that cannot be used, naming the body.
structure::Mesh to_mesh(const scene::Body& body);

// Length of the undeformed mesh along an axis [m].
double extent(const structure::Mesh& mesh, int axis);

// The place of a point of the undeformed body. Throws std::invalid_argument on a point
// outside, naming the body.
structure::MaterialPoint locate(const scene::Body& body, const structure::Mesh& mesh,
                                const structure::Vec3& at_m);

// Throws std::invalid_argument on what only the mesh can tell, naming the body;
// scene::SceneError on a region of material_regions that it does not have.
structure::Body to_body(const scene::Body& body);
// On another mesh of the same shape, regions and faces.
structure::Body to_body(const scene::Body& body, structure::Mesh mesh);
std::optional<structure::Vec3> to_gravity(const scene::Scene& scene);

}  // namespace magfsi::bodies
