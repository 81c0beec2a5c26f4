// The materials of a body, element by element.
#pragma once

#include <cstddef>
#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

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

}  // namespace magfsi::structure
