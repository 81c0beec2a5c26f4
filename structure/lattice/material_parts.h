// Elements sorted by material: the kernels hold the constants of one at a time.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "structure/lattice/lattice.h"

namespace magfsi::structure {

struct MaterialPart {
    Material material;
    std::vector<int> elements;  // of the lattice, in the order given
    std::vector<std::array<int, 8>> nodes;
};

// In the order of the lattice's materials, those without an element left out; nodes: for
// each of the elements its eight indices.
std::vector<MaterialPart> material_parts(const Lattice& lattice,
                                         std::span<const int> elements,
                                         std::span<const std::array<int, 8>> nodes);

}  // namespace magfsi::structure
