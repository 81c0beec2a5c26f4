// The mesh of a body as the scene describes it.
#pragma once

#include "adapters/scene/scene.h"
#include "structure/mesh/mesh.h"

namespace magfsi::bodies {

// Throws std::invalid_argument on a mesh file that cannot be used, naming the body.
structure::Mesh to_mesh(const scene::Body& body);

// Length of the undeformed mesh along an axis [m].
double extent(const structure::Mesh& mesh, int axis);

// The place of a point of the undeformed body. Throws std::invalid_argument on a point
// outside, naming the body.
structure::MaterialPoint locate(const scene::Body& body, const structure::Mesh& mesh,
                                const structure::Vec3& at_m);

}  // namespace magfsi::bodies
