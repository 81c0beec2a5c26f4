// One magttice body before it goes to LAMMPS. SI throughout.
#pragma once

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

}  // namespace magfsi::structure
