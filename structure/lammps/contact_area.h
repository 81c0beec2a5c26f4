// How much surface a node stands for in a contact.
#pragma once

#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Length of each node's share of the vector area of the boundary [m2], at rest: the
// tributary area on flat parts, that of the mean direction at edges and corners (a plain
// sum would make the edges of a sheet stiffer than its middle). Zero for inner nodes.
std::vector<double> contact_areas(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements);

}  // namespace magfsi::structure
