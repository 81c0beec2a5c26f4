// SPDX-License-Identifier: GPL-2.0-or-later
// A deformable body: its mesh, materials, magnetisation and supports. All quantities in
// SI.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// A part of a body that does not deform.
struct RigidPart {
    std::string name;               // of its region; empty: the whole body
    std::optional<RigidHold> hold;  // absent: it is free
};

// True if the motion of the part is prescribed.
inline bool is_moved(const RigidPart& part) {
    return part.hold && std::holds_alternative<RigidCourse>(*part.hold);
}

// A body as the solvers take it. It owns all of its data; one body is one fix magttice.
struct Body {
    std::string name;
    Mesh mesh;
    Material material;
    // Numbers of materials: 0 is `material`, 1 is the first of other_materials.
    // element_material holds the number of each element, in the order of mesh.elements;
    // it may be empty if all elements are made of `material`.
    std::vector<Material> other_materials;
    std::vector<int> element_material;
    ElementVariant element = ElementVariant::assumed_strain;
    Inertia inertia = Inertia::lumped;
    // Magnetisation of the undeformed elements [A/m], one vector per element; empty if
    // the body is not magnetic
    std::vector<Vec3> magnetization_a_m;
    MagnetizationFollows follows = MagnetizationFollows::deformation;
    // Names of faces in mesh.faces whose nodes are held along all axes
    std::vector<std::string> clamps;
    // Faces whose nodes are held along one axis
    std::vector<Roller> rollers;
    // Rigid parts, and the number of each element's part, -1 for soft elements; both are
    // empty in a body without rigid parts. Their nodes may belong to soft elements, too.
    std::vector<RigidPart> rigid_parts;
    std::vector<int> element_rigid;
};

// True unless the element belongs to a rigid part.
inline bool is_soft(const Body& body, std::size_t element) {
    return body.element_rigid.empty() || body.element_rigid[element] < 0;
}

// True if no element is soft.
bool is_all_rigid(const Body& body);

// True if a body has a rigid part in prescribed motion.
bool has_moved_parts(std::span<const Body> bodies);

// Number of each node's rigid part, -1 for the others; empty without rigid parts. Throws
// std::invalid_argument unless element_rigid has one number of a part, or -1, for each
// element and each part is one connected piece without a node of another part.
std::vector<int> rigid_part_of_nodes(const Body& body);

// The material of an element. The body must have passed check_materials.
inline const Material& material_of(const Body& body, std::size_t element) {
    const int number = body.element_material.empty() ? 0 : body.element_material[element];
    return number == 0 ? body.material
                       : body.other_materials[static_cast<std::size_t>(number) - 1];
}

// All materials of the body, in the order of their numbers.
std::vector<Material> all_materials(const Body& body);

// The materials that at least one element is made of, in the order of their numbers. The
// body must have passed check_materials.
std::vector<Material> used_materials(const Body& body);

// True if the body is magnetised and its magnetisation follows the rotation.
inline bool is_turned(const Body& body) {
    return !body.magnetization_a_m.empty() &&
           body.follows == MagnetizationFollows::rotation;
}

// The materials whose modulus decides how hard bodies press on each other and on walls:
// those of the body's soft elements, as a rigid part that is far stiffer would only
// shorten the step. Where no body has a soft element they are those that have a modulus.
std::vector<Material> pressing_materials(const Body& body, std::span<const Body> all);

// True if at least one of the body's materials has a viscosity, or Maxwell branches.
bool is_viscous(const Body& body);
bool is_viscoelastic(const Body& body);

// Throws std::invalid_argument unless element_material has one number from 0 to `others`
// for each element. It may be empty where there are no other materials.
void check_materials(const std::vector<int>& element_material, std::size_t elements,
                     std::size_t others);

// The nodes of a face, as numbers in mesh.nodes. how: the participle in the error
// message, such as "clamped". Throws std::invalid_argument, with the names of the faces
// that there are, if the mesh has no face of this name.
const std::vector<int>& face_nodes(const Body& body, const std::string& face,
                                   const char* how);

// For each node the axes (x, y, z) along which a clamp or a roller holds it. Clamps on
// the faces `moved`, those of a prescribed motion, are left out. Throws as face_nodes
// does.
using HeldAxes = std::array<bool, 3>;
std::vector<HeldAxes> held_axes(const Body& body,
                                const std::set<std::string>& moved = {});

// Throws std::invalid_argument if an axis of a node of a rigid part is held.
void refuse_held_rigid_parts(const Body& body, const std::vector<HeldAxes>& held);

// A face with a clamp or a roller, and the nodes that it holds along x, y and z. Each
// axis of a node is listed at one face only, so that reaction forces summed by face count
// each node once: clamps take it first, then rollers, each in the order of the body.
struct HeldFace {
    std::string name;
    std::array<std::vector<int>, 3> nodes;
};
// All held faces of the body. Throws std::invalid_argument as face_nodes does.
std::vector<HeldFace> held_faces(const Body& body);

}  // namespace magfsi::structure
