// The line through a body that its shape is measured on.
#pragma once

#include <span>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Nodes as material points, in the order of the coordinate in which they extend farthest
// (x before y before z): a line that does not turn back. Throws std::invalid_argument for
// a node of no element.
std::vector<MaterialPoint> line_through(const Mesh& mesh, std::span<const int> nodes);

}  // namespace magfsi::structure
