#include "structure/lattice/material_parts.h"

namespace magfsi::structure {

std::vector<MaterialPart> material_parts(const Lattice& lattice,
                                         std::span<const int> elements,
                                         std::span<const std::array<int, 8>> nodes) {
    std::vector<MaterialPart> out(lattice.materials.size());
    for (std::size_t m = 0; m < out.size(); ++m) out[m].material = lattice.materials[m];
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto e = static_cast<std::size_t>(elements[i]);
        const auto m = static_cast<std::size_t>(
            lattice.element_material.empty() ? 0 : lattice.element_material[e]);
        out[m].elements.push_back(elements[i]);
        out[m].nodes.push_back(nodes[i]);
    }
    std::erase_if(out, [](const MaterialPart& part) { return part.elements.empty(); });
    return out;
}

}  // namespace magfsi::structure
