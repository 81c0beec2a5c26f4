// One magttice body before it goes to LAMMPS. SI throughout.
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
    // Of a body of several materials: element e is of `material` where
    // element_material[e] is 0, else of other_materials[element_material[e] - 1]. Both
    // empty: all is `material`.
    std::vector<Material> other_materials;
    std::vector<int> element_material;
    ElementVariant element = ElementVariant::full;
    std::vector<Vec3> magnetization_a_m;  // one an element; empty: not magnetic
    std::vector<std::string> clamps;      // faces held still
    std::vector<Roller> rollers;
};

// Unchecked: check_materials has passed.
inline const Material& material_of(const Body& body, std::size_t element) {
    const int number = body.element_material.empty() ? 0 : body.element_material[element];
    return number == 0 ? body.material
                       : body.other_materials[static_cast<std::size_t>(number) - 1];
}

// `material` and the others, numbered as element_material counts.
std::vector<Material> all_materials(const Body& body);

// Those that an element is made of.
std::vector<Material> used_materials(const Body& body);

// Whether one of its materials damps its strain rate.
bool is_viscous(const Body& body);

// Throws std::invalid_argument where element_material has not one number an element
// between 0 and `others`; it may be empty where there are no others.
void check_materials(const std::vector<int>& element_material, std::size_t elements,
                     std::size_t others);

// The nodes of a face. Throws std::invalid_argument where the mesh lacks it; how: what is
// said of the body there, such as "clamped".
const std::vector<int>& face_nodes(const Body& body, const std::string& face,
                                   const char* how);

// Which axes of each node the rollers hold, and the clamps but those of the faces that
// are `moved`. Throws as face_nodes does.
using HeldAxes = std::array<bool, 3>;
std::vector<HeldAxes> held_axes(const Body& body,
                                const std::set<std::string>& moved = {});

}  // namespace magfsi::structure
