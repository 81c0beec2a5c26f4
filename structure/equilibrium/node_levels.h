// Slices of a body across its longest side, the order in which its tangent is factorised.
#pragma once

#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// An element joins nodes of one level or of two neighbouring ones, so the tangent is
// block tridiagonal. The levels are the distances, counted in elements, from the end of
// the body's longest side; for a block of bricks they are its cross-sections.
struct NodeLevels {
    std::vector<int> level;  // of each node; -1 for a node of no element
    std::vector<int> slot;   // place of each node within its level
    std::vector<int> size;   // nodes of each level
};

NodeLevels node_levels(const Mesh& mesh);

}  // namespace magfsi::structure
