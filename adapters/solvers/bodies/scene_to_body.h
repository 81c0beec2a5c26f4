// SPDX-License-Identifier: GPL-2.0-or-later
// Conversion of the scene's bodies, meshes and loads to the types of structure/.
#pragma once

#include <optional>
#include <vector>

#include "adapters/scene/scene.h"
#include "structure/body.h"

namespace magfsi::bodies {

// The mesh of a body in its own frame [m]. Gmsh's files are read by the program
// magfsi-mesh in a process of its own, STL surfaces by filled_mesh. Throws
// scene::SceneError, which names the body and the place in the scene, on a mesh or a mesh
// file that cannot be used.
structure::Mesh to_mesh(const scene::Body& body);

// Length of the undeformed mesh along an axis (0 x, 1 y, 2 z) [m].
double extent(const structure::Mesh& mesh, int axis);

// The material point at a place of the undeformed body [m, frame of the body]. A point
// outside a block is moved to its surface. Other meshes accept points up to 0.001 of an
// element outside; on points further outside std::invalid_argument is thrown, which names
// the body.
structure::MaterialPoint locate(const scene::Body& body, const structure::Mesh& mesh,
                                const structure::Vec3& at_m);

// The body with its mesh, materials, magnetisation and supports. Faces in prescribed
// motion are among its clamps. Its density is that of the scene (bodies_in_fluid
// subtracts the enclosed fluid). Throws std::invalid_argument, which names the body, on
// faults that only the mesh shows; scene::SceneError on a faulty mesh, and on a region of
// material_regions that the mesh does not have.
structure::Body to_body(const scene::Body& body);
// The same body on another mesh of the same shape, with the same regions and faces.
structure::Body to_body(const scene::Body& body, structure::Mesh mesh);

// The bodies of a scene by to_body, in its order. A process makes them once and hands
// them on. Bodies with equal keys `mesh` share the work of making it.
using Solids = std::vector<structure::Body>;
Solids to_bodies(const scene::Scene& scene);

// Acceleration of gravity [m/s2]; empty without gravity in the scene.
std::optional<structure::Vec3> to_gravity(const scene::Scene& scene);

}  // namespace magfsi::bodies
