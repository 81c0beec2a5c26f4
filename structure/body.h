// SPDX-License-Identifier: GPL-2.0-or-later
// A body: its mesh, what it is made of, its magnetisation and what holds it. SI
// throughout.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

struct Body {
    std::string name;
    Mesh mesh;
    Material material;
    // For a body of several materials, which are numbered: 0 is `material`, 1 the first
    // of other_materials. element_material has the number of each element; it may be
    // empty where all elements are of `material`.
    std::vector<Material> other_materials;
    std::vector<int> element_material;
    ElementVariant element = ElementVariant::assumed_strain;
    Inertia inertia = Inertia::lumped;
    std::vector<Vec3> magnetization_a_m;  // one an element; empty: not magnetic
    std::vector<std::string> clamps;      // faces held still
    std::vector<Roller> rollers;
};

// The material of an element. The body must have passed check_materials.
inline const Material& material_of(const Body& body, std::size_t element) {
    const int number = body.element_material.empty() ? 0 : body.element_material[element];
    return number == 0 ? body.material
                       : body.other_materials[static_cast<std::size_t>(number) - 1];
}

// All materials of the body, in the order of their numbers.
std::vector<Material> all_materials(const Body& body);

// Only those that at least one element is made of.
std::vector<Material> used_materials(const Body& body);

// Whether one of its materials has a viscosity.
bool is_viscous(const Body& body);

// Throws std::invalid_argument unless element_material has one number from 0 to `others`
// for each element. It may be empty where there are no other materials.
void check_materials(const std::vector<int>& element_material, std::size_t elements,
                     std::size_t others);

// The nodes of a face. Throws std::invalid_argument where the mesh lacks it; how: what is
// said of the body there, such as "clamped".
const std::vector<int>& face_nodes(const Body& body, const std::string& face,
                                   const char* how);

// For each node the axes along which a clamp or a roller holds it. Clamps on the faces
// `moved` are left out. Throws as face_nodes does.
using HeldAxes = std::array<bool, 3>;
std::vector<HeldAxes> held_axes(const Body& body,
                                const std::set<std::string>& moved = {});

// What holds a body, face by face: its clamps, then its rollers, a face each. Along each
// axis a node belongs to the first face that holds it.
struct HeldFace {
    std::string name;
    std::array<std::vector<int>, 3> nodes;  // held along x, y, z
};
std::vector<HeldFace> held_faces(const Body& body);

}  // namespace magfsi::structure
